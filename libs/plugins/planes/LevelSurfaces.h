#pragma once

#include <omnimapper/map/KeyFrames.h>
#include <omnimapper/map/Level.h>
#include <omnimapper/surfaces/Classification.h>

#include <optional>
#include <vector>

#include "PlaneLandmarksPlugin.h"

namespace omnimapper::plugins {

/// The surfaces of a map, turned so that up is z, for whoever judges by what is level, upright, high or low.
class LevelSurfaces {
 public:
  /// Without a level z of the map is up.
  explicit LevelSurfaces(std::optional<map::Level> level) : level_(std::move(level)) {}

  void add(const surfaces::Surface& in_map);
  /// As they lie where z is up; in the order in which they were added.
  const std::vector<surfaces::Surface>& all() const { return surfaces_; }
  /// What each of them is. Where nobody knows which way is up all are "surface".
  std::vector<surfaces::Judgement> judged(PlaneLandmarksOptions::Ground ground, const map::KeyFrames& key_frames) const;
  /// z of where people walk in the level frame [m]. Of a base that stands on it, or of poses whose z = 0 it is, that;
  /// else the lowest large level surface, else the lowest corner.
  double floor(PlaneLandmarksOptions::Ground ground, const map::KeyFrames& key_frames) const;

 private:
  bool isMapLevel() const;

  std::optional<map::Level> level_;
  std::vector<surfaces::Surface> surfaces_;
};

}  // namespace omnimapper::plugins
