#pragma once

#include <omnimapper/sim_world/World.h>

#include <vector>

namespace omnimapper::sim {

/// Stains, scuffs and grain: how bright a surface is varies from place to place and repeats nowhere, in patches of 1 cm
/// to 0.6 m that all have the same contrast. Only what always stands still is worn, and neither glass nor what hangs on
/// walls to be read. Immutable, thread-safe.
class Wear {
 public:
  explicit Wear(const World& world);
  /// What the colour at a place in the map is multiplied by. `surface` is a number of numberSurfaces(); a pixel covers
  /// about `pixel_side` [m], and what is finer is averaged away.
  float factorAt(int surface, const Eigen::Vector3f& in_map, float pixel_side) const;

 private:
  float amplitude_;            // of one size of patches
  Eigen::Vector3f origin_;     // by the world's seed, in patches
  std::vector<char> is_worn_;  // by surface number
};

}  // namespace omnimapper::sim
