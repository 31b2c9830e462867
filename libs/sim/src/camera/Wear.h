#pragma once

#include <omnimapper/sim_world/World.h>

#include <vector>

namespace omnimapper::sim {

/// Stains, scuffs and grain: the brightness of a surface varies from place to place without repeating, in patches of 1
/// cm to 0.6 m that all have the same contrast. Only surfaces of bodies that never move are worn, but not glass, signs,
/// posters and markers. Immutable, thread-safe.
class Wear {
 public:
  explicit Wear(const World& world);
  /// Factor on the colour at a place in the map. `surface` is a number of numberSurfaces(); a pixel covers about
  /// `pixel_side` [m], and finer patches are averaged away.
  float factorAt(int surface, const Eigen::Vector3f& in_map, float pixel_side) const;

 private:
  float amplitude_;            // of one size of patches
  Eigen::Vector3f origin_;     // drawn by the world's seed, in units of patches
  std::vector<char> is_worn_;  // by surface number
};

}  // namespace omnimapper::sim
