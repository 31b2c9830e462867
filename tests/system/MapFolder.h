#pragma once

#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/eval/AbsoluteTrajectoryError.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "Runs.h"

/// Functions that read what a run wrote to its output folder.
namespace runs {

using omnimapper::testing::SimulatedLog;
namespace map_file = omnimapper::map;

using LoadedMap = omnimapper::derived::SavedMap;

/// Loads map.omnimap. Throws base::Error if any part of it is damaged.
inline LoadedMap loadMap(const std::string& folder) {
  omnimapper::mapper::loadFeatures();  // registers the classes of its observations
  return omnimapper::derived::readMap(folder + "/map.omnimap", omnimapper::mapper::registeredKinds());
}

inline omnimapper::eval::Trajectory loadTrajectory(const std::string& folder) {
  return omnimapper::eval::readTum(folder + "/trajectory.tum");
}

inline nlohmann::json loadSummary(const std::string& folder) {
  return nlohmann::json::parse(readFile(folder + "/summary.json"));
}

/// An accepted closure: the scan at `here` was matched with the place that was visited at `place`.
struct LoopClosure {
  omnimapper::base::Stamp place, here;
  omnimapper::geometry::Se2 place_from_here;
};

inline std::vector<LoopClosure> loopClosures(const LoadedMap& loaded) {
  std::map<omnimapper::base::VariableId, omnimapper::base::Stamp> stamps;
  for (const auto& frame : loaded.map.key_frames) stamps[frame.pose] = frame.stamp;
  std::vector<LoopClosure> closures;
  for (const auto& [id, record] : loaded.graph.factors()) {
    if (!record.tags.hypothesis || record.weight == 0) continue;
    const auto& between = dynamic_cast<const omnimapper::graph::BetweenSe2&>(*record.factor);
    closures.push_back({stamps.at(record.variables[0]), stamps.at(record.variables[1]), between.measured()});
  }
  return closures;
}

/// The truth of a simulated log at the stamps of an estimate, relative to the true pose at the first of them.
inline omnimapper::eval::Trajectory truthFor(const SimulatedLog& log, const omnimapper::eval::Trajectory& estimate) {
  omnimapper::eval::Trajectory truth;
  const auto start = log.truthAt(estimate.front().stamp);
  for (const auto& pose : estimate) {
    truth.push_back(
        {pose.stamp, omnimapper::geometry::fromMrpt(mrpt::poses::CPose3D(log.truthAt(pose.stamp) - start))});
  }
  return truth;
}

/// Root mean square distance [m] from the truth, both relative to the first pose.
inline double errorAgainst(const SimulatedLog& log, const omnimapper::eval::Trajectory& estimate) {
  return omnimapper::eval::absoluteTrajectoryError(estimate, truthFor(log, estimate)).translation.rmse;
}

/// Stamps of the scans of a simulated log.
inline std::vector<omnimapper::base::Stamp> scanStamps(const SimulatedLog& log, const std::string& label = "laser") {
  std::vector<omnimapper::base::Stamp> stamps;
  for (const auto& observation : log.observations()) {
    if (observation->sensorLabel == label) stamps.push_back(observation->timestamp);
  }
  return stamps;
}

inline std::vector<omnimapper::base::Stamp> stampsOf(const omnimapper::eval::Trajectory& trajectory) {
  std::vector<omnimapper::base::Stamp> stamps;
  for (const auto& pose : trajectory) stamps.push_back(pose.stamp);
  return stamps;
}

}  // namespace runs
