#pragma once

// All available 2D laser logs, in variants for which nothing was tuned. bench-robustness maps all of them, the tests a
// few.
#include <omnimapper/base/Stamp.h>
#include <omnimapper/eval/AbsoluteTrajectoryError.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/source/openLogs.h>
#include <omnimapper/testing/ChildProgram.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/LogVariants.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace untuned {

using omnimapper::testing::LogVariant;
using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

constexpr double kWrong = 1;  ///< [m] absolute trajectory error above which a map is wrong

struct Log {
  std::string name, path, reference;
  bool is_thin = false;  ///< its scans are already 0.5 to 1 m apart
};

/// The log of this name: a recording, or one of MRPT's simulated logs. Its reference is the simulator's truth, the
/// corrected poses of another mapper, or, if there is neither (ual, driving_in_office, malaga), our own map of the
/// unchanged log, which was inspected and is kept in tests/bench/references. None if the log is not on this machine.
inline std::optional<Log> logNamed(const std::string& name) {
  namespace tests = omnimapper::testing;
  const auto is_one_of = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::optional<std::string> path, reference = tests::sourceFile("tests/bench/references/" + name + ".tum");
  if (is_one_of({"simul", "range_030_bearing_015"})) {
    const std::string demo = "graphslam-engine-demos/action_observations_map/" + name + ".rawlog";
    path = tests::mrptDataset(demo);
    reference = tests::mrptDataset(demo + ".GT.txt");
  } else if (name == "malaga") {
    path = tests::mrptDataset("2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog");
  } else if (is_one_of({"ual", "driving_in_office"})) {
    path = tests::sharedData("laser2d/" + name + ".rawlog");
  } else {
    path = tests::sharedData("laser2d/" + name + ".clf.bz2");
    reference = tests::sharedData("laser2d/" + name + ".reference.tum");
  }
  if (!path || !reference || !std::filesystem::exists(*reference)) return std::nullopt;
  return Log{name, *path, *reference, is_one_of({"fhw", "belgioioso"})};
}

/// The observations of a log that have a stamp, in the order of stamps.
inline Observations read(const Log& log) {
  namespace source = omnimapper::source;
  const auto in = source::openLogs({log.path}, {});
  Observations all;
  while (auto observation = in->next()) {
    if (omnimapper::base::isValid(observation->timestamp)) all.push_back(std::move(observation));
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
  return all;
}

/// A log of laser and wheels only, which the simulator writes into the folder `out` unless it is there already.
inline std::optional<Log> simulated(const std::string& name, const std::string& out) {
  const std::string folder = out + "/simulated/" + name;
  Log log{"simulated " + name, folder + "/" + name + ".rawlog", folder + "/truth.tum"};
  if (std::filesystem::exists(log.path)) return log;
  const auto ended = omnimapper::testing::runProgram({omnimapper::testing::ownProgram("omnimapper-simulate"), "-q",
                                                      "-i", omnimapper::testing::sourceFile("rawlogs/" + name + ".ini"),
                                                      "--set", "simulation.sensors=laser, odometry", "-o", folder},
                                                     {600, 0});
  if (ended.code == 0) return log;
  std::fprintf(stderr, "%s could not be simulated: %s\n", name.c_str(), omnimapper::testing::toString(ended).c_str());
  return std::nullopt;
}

/// The recordings that are on this machine, and the simulated logs, which are kept in `out`.
inline std::vector<Log> logsAtHand(const std::string& out) {
  std::vector<Log> logs;
  for (const std::string name : {"aces", "intel", "mit-csail", "fhw", "belgioioso", "freiburg-campus", "ual",
                                 "driving_in_office", "malaga", "simul", "range_030_bearing_015"}) {
    if (const auto log = untuned::logNamed(name)) {
      logs.push_back(*log);
    } else {
      std::fprintf(stderr, "%s is not on this machine\n", name.c_str());
    }
  }
  for (const std::string name : {"home", "office", "laboratory", "loop_200", "loop_400"}) {
    if (const auto log = simulated(name, out)) logs.push_back(*log);
  }
  return logs;
}

inline void writeVariant(const Observations& log, LogVariant variant, const std::string& path) {
  omnimapper::source::writeRawlog(path, [&](omnimapper::source::RawlogWriter& rawlog) {
    for (const auto& observation : omnimapper::testing::variantOf(log, variant)) rawlog.add(*observation);
  });
}

/// The command that maps the log into the folder in one thread, without pictures. `settings`: section.key=value.
inline std::vector<std::string> mappingCommand(const std::string& ini, const std::string& log,
                                               const std::string& folder, const std::vector<std::string>& settings) {
  std::vector<std::string> command{omnimapper::testing::ownProgram("omnimapper-graphslam"),
                                   "-q",
                                   "-i",
                                   ini,
                                   "-r",
                                   log,
                                   "-o",
                                   folder,
                                   "--threads",
                                   "1",
                                   "--set",
                                   "mapper.output_plugins=trajectory,summary"};
  for (const auto& setting : settings) command.insert(command.end(), {"--set", setting});
  return command;
}

/// The reference trajectory of a variant of the log.
inline omnimapper::eval::Trajectory truthOf(const Log& log, const Observations& observations, LogVariant variant) {
  auto truth = omnimapper::eval::readTrajectory(log.reference);
  if (variant == LogVariant::reversed) {
    for (auto& pose : truth) pose.stamp = omnimapper::testing::reversedStamp(observations, pose.stamp);
    std::reverse(truth.begin(), truth.end());
  }
  return truth;
}

/// Our trajectory is interpolated at the stamps of the reference, since the reference is sparse and ours is dense.
inline omnimapper::eval::PairingOptions pairing() {
  omnimapper::eval::PairingOptions options;
  options.alignment = omnimapper::eval::Alignment::yaw;
  options.longest_gap = omnimapper::base::durationFromSeconds(10);
  return options;
}

/// Root mean square error [m] after the best rigid alignment.
inline double errorOf(const omnimapper::eval::Trajectory& trajectory, const omnimapper::eval::Trajectory& truth) {
  return omnimapper::eval::absoluteTrajectoryError(truth, trajectory, pairing()).translation.rmse;
}

}  // namespace untuned
