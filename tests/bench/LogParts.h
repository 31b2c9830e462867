#pragma once

#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/eval/Trajectory.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/RawlogWriter.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

// Logs in parts, of which one is mapped and another one continues that map or is localized in it.
namespace omnimapper::log_parts {

inline std::pair<base::Stamp, base::Stamp> spanOf(const std::string& log) {
  source::RawlogSource source(log);
  base::Stamp begin = base::Stamp::max(), end = base::Stamp::min();
  while (const auto observation = source.next()) {
    if (!base::isValid(observation->timestamp)) continue;
    begin = std::min(begin, observation->timestamp);
    end = std::max(end, observation->timestamp);
  }
  return {begin, end};
}

inline void write(const std::string& log, base::Stamp from, base::Stamp until, const std::string& path) {
  source::RawlogSource source(log);
  source::writeRawlog(path, [&](source::RawlogWriter& writer) {
    while (const auto observation = source.next()) {
      if (observation->timestamp >= from && observation->timestamp < until) writer.add(*observation);
    }
  });
}

inline eval::Trajectory trajectoryOf(const map::Map& map) {
  std::vector<eval::StampedPose> poses;
  for (const auto& pose : map::denseTrajectory(map))
    poses.push_back({pose.stamp, geometry::fromMrpt(pose.map_from_base)});
  return eval::sortedByStamp(std::move(poses), "map");
}

inline map::Map mapIn(const std::string& folder) {
  return derived::readMap(folder, mapper::registeredKinds()).map;
}

}  // namespace omnimapper::log_parts
