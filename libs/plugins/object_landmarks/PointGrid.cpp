#include "PointGrid.h"

#include <algorithm>

namespace omnimapper::plugins {

double shareNear(const PointGrid& grid, const std::vector<Eigen::Vector3f>& points) {
  constexpr std::size_t kTried = 200;
  if (points.empty()) return 0;
  const std::size_t count = std::min(points.size(), kTried);
  std::size_t near = 0;
  for (std::size_t i = 0; i < count; ++i) near += grid.hasNear(points[i * points.size() / count]);
  return static_cast<double>(near) / static_cast<double>(count);
}

}  // namespace omnimapper::plugins
