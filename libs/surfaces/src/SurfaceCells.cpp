#include "SurfaceCells.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace omnimapper::surfaces {

FilledCells cellsOf(const Surface& surface) {
  constexpr double kCell = 0.05, kMostCells = 500;  // [m], along a side
  const auto corners = cornersOf(surface);
  Eigen::AlignedBox3d box;
  for (const auto& corner : corners) box.extend(corner);
  auto grid = CellGrid::around(surface.plane, corners, std::max(kCell, box.diagonal().norm() / kMostCells));
  for (const auto& part : surface.parts) grid.fill(part.outline, part.holes);
  FilledCells cells{{}, grid.area()};
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column)
      if (grid.isSet({column, row})) cells.middles.push_back(grid.middleOf({column, row}));
  if (cells.middles.empty()) cells.middles = corners;
  return cells;
}

Eigen::Vector2d rangeAlong(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& along) {
  constexpr double kOutlying = 1.0 / 30;
  std::vector<double> values;
  for (const auto& point : points) values.push_back(along.dot(point));
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  const double low = values[static_cast<std::size_t>(kOutlying * last)],
               high = values[static_cast<std::size_t>((1 - kOutlying) * last)];
  const double beyond = (high - low) * kOutlying / (1 - 2 * kOutlying);  // length that an even distribution has there
  return {low - beyond, high + beyond};
}

}  // namespace omnimapper::surfaces
