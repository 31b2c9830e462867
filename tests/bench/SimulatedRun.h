#pragma once

#include <omnimapper/base/Progress.h>
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/eval/AbsoluteTrajectoryError.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/mapper/PluginRegistry.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace omnimapper::bench {

/// A folder that omnimapper-simulate wrote.
struct SimulatedPlace {
  std::string folder;

  std::string name() const { return std::filesystem::path(folder).filename().string(); }
  std::string log() const { return folder + "/" + name() + ".rawlog"; }
};

struct SimulatedRun {
  derived::SavedMap saved;
  eval::Statistics error;  ///< [m] of the trajectory after the best alignment by yaw and offset
  nlohmann::json summary;
};

/// Maps the log into the folder `out`. `settings` are of the form section.key=value.
inline SimulatedRun mapSimulated(const SimulatedPlace& place, const std::string& ini,
                                 const std::vector<std::string>& settings, const std::string& out, int threads) {
  auto config = base::Config::fromFile(ini);
  for (const auto& setting : settings) config.set(setting);
  config.set("mapper.output_plugins=map,trajectory,summary");
  mapper::RunRequest request;
  request.logs = {place.log()};
  request.output_folder = out;
  request.threads = threads;
  std::filesystem::create_directories(out);
  base::Progress quiet;
  mapper::runMapping(request, config, quiet, [] { return false; });
  SimulatedRun run{derived::readMap(out + "/map.omnimap", mapper::registeredKinds()), {}, {}};
  eval::PairingOptions pairing;
  pairing.alignment = eval::Alignment::yaw;
  run.error = eval::absoluteTrajectoryError(eval::readTum(out + "/trajectory.tum"),
                                            eval::readTrajectory(place.folder + "/truth.tum"), pairing)
                  .translation;
  std::ifstream in(out + "/summary.json");
  run.summary = nlohmann::json::parse(in);
  return run;
}

}  // namespace omnimapper::bench
