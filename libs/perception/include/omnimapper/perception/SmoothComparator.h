#pragma once

#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/Normals.h>
#include <omnimapper/perception/OrganizedPoints.h>

#include <cmath>

namespace omnimapper::perception {

/// Comparator for connectComponents(): joins neighbours on one smooth surface. It compares the planes through their
/// points, with their normals (thesis 3.4.3).
struct SmoothComparator {
  const OrganizedPoints& points;
  const NormalImage& normals;
  float min_cosine = 0.9986F;        ///< cosine of the largest angle between the normals: 3 deg
  float max_offset_at_1m = 0.0069F;  ///< [m] largest difference of the planes' distances at 1 m, which grows with the
                                     ///< squared depth; by default three standard deviations of the noise

  bool valid(int pixel) const {
    const auto i = static_cast<std::size_t>(pixel);
    return !std::isnan(normals.z()[i]) && !std::isnan(points.z[i]);
  }

  bool similar(int a, int b) const {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const float cosine =
        normals.x()[i] * normals.x()[j] + normals.y()[i] * normals.y()[j] + normals.z()[i] * normals.z()[j];
    return cosine >= min_cosine && std::abs(offset(i) - offset(j)) <= max_offset_at_1m * points.z[j] * points.z[j];
  }

  /// Signed distance [m] of the plane through a pixel's point from the sensor, along the pixel's normal.
  float offset(std::size_t i) const {
    return normals.x()[i] * points.x[i] + normals.y()[i] * points.y[i] + normals.z()[i] * points.z[i];
  }
};

extern template Components connectComponents(int, int, const SmoothComparator&);

}  // namespace omnimapper::perception
