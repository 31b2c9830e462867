#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/Normals.h>
#include <omnimapper/perception/OrganizedPoints.h>

#include <cmath>

namespace omnimapper::perception {

/// Comparator for connectComponents(): joins neighbours on ground that may rise and fall smoothly and is near the
/// expected ground (thesis 3.4.7).
struct RoadComparator {
  const OrganizedPoints& points;
  const NormalImage& normals;
  Eigen::Vector3f up = -Eigen::Vector3f::UnitY();  ///< unit normal of the expected ground, in the optical frame
  float height = 0;                                ///< [m] height of the sensor above the expected ground
  float min_cosine = 0.94F;                        ///< cosine of the largest angle between a normal and `up`: 20 deg
  float max_off = 0.3F;                            ///< [m] largest distance from the expected ground
  float max_slope = 0.1F;                          ///< [-] increase of max_off with each metre of depth
  float min_cosine_between = 0.98F;                ///< cosine of the largest angle between the normals of neighbours

  bool valid(int pixel) const {
    const auto i = static_cast<std::size_t>(pixel);
    // NaN fails every comparison.
    return normals.x()[i] * up.x() + normals.y()[i] * up.y() + normals.z()[i] * up.z() >= min_cosine && isNear(i);
  }

  bool similar(int a, int b) const {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    return normals.x()[i] * normals.x()[j] + normals.y()[i] * normals.y()[j] + normals.z()[i] * normals.z()[j] >=
           min_cosine_between;
  }

  /// Whether the point is near enough to the expected ground to be ground.
  bool isNear(std::size_t i) const {
    const float above = points.x[i] * up.x() + points.y[i] * up.y() + points.z[i] * up.z() + height;
    return std::abs(above) <= max_off + max_slope * points.z[i];
  }
};

extern template Components connectComponents(int, int, const RoadComparator&);

}  // namespace omnimapper::perception
