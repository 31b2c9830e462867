#pragma once

#include <omnimapper/map/KeyFrames.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/surfaces/Classification.h>

#include <optional>
#include <vector>

#include "PlaneLandmarksOptions.h"

namespace omnimapper::plugins {

/// The surfaces of a map, rotated so that z is up, to judge them by slope and height.
class LevelSurfaces {
 public:
  /// Without `level`, z of the map is up.
  /// `level`: which way is up in the map; null if the map does not say, and z then counts as up.
  explicit LevelSurfaces(const map::Level* level) {
    if (level) level_ = *level;
  }

  void add(const surfaces::Surface& in_map);
  /// The rotated surfaces, in the order in which they were added.
  const std::vector<surfaces::Surface>& all() const { return surfaces_; }
  /// The class of each surface; "surface" for all if it is not known which way is up.
  std::vector<surfaces::Judgement> judged(PlaneLandmarksOptions::Ground ground, const map::KeyFrames& key_frames) const;
  /// Height of the floor that people walk on, in the level frame [m]. It is 0 with Ground::map in a level map.
  /// Otherwise it is the height of the first base if the base stands on the floor. If it does not, it is the height of
  /// the lowest large level surface or, without such a surface, of the lowest corner.
  double floor(PlaneLandmarksOptions::Ground ground, const map::KeyFrames& key_frames) const;

 private:
  bool isMapLevel() const;

  std::optional<map::Level> level_;
  std::vector<surfaces::Surface> surfaces_;
};

}  // namespace omnimapper::plugins
