#pragma once

#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/OrganizedPoints.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace omnimapper::perception {

/// Comparator for connectComponents(): joins neighbours that are close together in space and on no masked surface
/// (thesis 3.4.6), such as the pixels of an object on a table whose plane is masked.
struct ClusterComparator {
  const OrganizedPoints& points;
  const std::vector<std::uint16_t>& labels;  ///< label of each pixel, such as PlaneSegmentation::labels
  const std::vector<std::uint8_t>& masked;   ///< for each label, 0 included, whether its pixels are left out
  float max_gap = 0.02F;                     ///< [m]
  float max_gap_at_1m = 0.0069F;  ///< [m] noise at 1 m; multiplied by the squared depth, it is added to max_gap

  bool valid(int pixel) const {
    const auto i = static_cast<std::size_t>(pixel);
    return masked[labels[i]] == 0 && !std::isnan(points.z[i]);
  }

  bool similar(int a, int b) const {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const float x = points.x[i] - points.x[j], y = points.y[i] - points.y[j], z = points.z[i] - points.z[j];
    const float gap = max_gap + max_gap_at_1m * points.z[i] * points.z[j];
    return x * x + y * y + z * z <= gap * gap;
  }
};

extern template Components connectComponents(int, int, const ClusterComparator&);

}  // namespace omnimapper::perception
