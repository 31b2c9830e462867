#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/map/MapSection.h>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::map {

/// A loop closure that the map rests on: two key frames that do not follow one another, and are tied by a measurement
/// which could be wrong.
struct ClosedLoop {
  base::KeyFrameId from, to;
  Eigen::Vector2d from_in_map = Eigen::Vector2d::Zero(), to_in_map = Eigen::Vector2d::Zero();  ///< [m]
  std::string owner;  ///< INI section of the plugin that closed it
  std::string note;   ///< why, a few words; may be empty
};

/// The loop closures of a saved map, for whoever shows them without plugins: its layer "loops". Like Places, it is
/// computed whenever a map is saved, and a run that continues the map does not load it.
struct ClosedLoops {
  static constexpr char kLayer[] = "loops";
  static constexpr std::uint32_t kLayerVersion = 1;

  std::vector<ClosedLoop> loops;  ///< in the order of the ids of their factors

  std::string toBytes() const;
  /// Throws Error(unreadable_input) if the section is another one, of a later version or damaged.
  static ClosedLoops fromSection(const MapSection& section);
};

}  // namespace omnimapper::map
