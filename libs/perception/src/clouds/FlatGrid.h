#pragma once

#include <omnimapper/perception/ConnectedComponents.h>

#include <cstdint>
#include <vector>

#include "PlaneSearch.h"

namespace omnimapper::perception::clouds {

/// A grid of square cells on a plane, with the cells that points fill.
class FlatGrid {
 public:
  static constexpr int kNone = -1;

  /// Covers the points `members`, which must not be empty. Cells are larger than `cell` [m] if there would be too
  /// many.
  FlatGrid(const LoosePoints& points, const std::vector<int>& members, const geometry::Plane3& plane, double cell);

  int width() const { return width_; }
  int height() const { return height_; }
  /// 1 for cells with points, row by row.
  const std::vector<std::uint16_t>& filled() const { return filled_; }
  std::size_t cellOf(int point) const { return static_cast<std::size_t>(cellOrNone(point)); }
  /// As cellOf(), but kNone for a point outside the grid.
  int cellOrNone(int point) const;
  /// Position of a point on the plane, in cells from the upper left corner of the first cell.
  Eigen::Vector2d at(int point) const;
  /// A point of the cloud [m].
  Eigen::Vector3d point(int point) const { return points_.at(static_cast<std::size_t>(point)); }

 private:
  const LoosePoints& points_;
  Eigen::Matrix<double, 3, 2> basis_;  // along the columns and the rows
  Eigen::Vector2d corner_;             // [m]
  double cell_;                        // [m]
  int width_, height_;
  std::vector<std::uint16_t> filled_;
};

/// Sets the outline and the holes of `plane` from the points `members`, which fill one component of the grid's cells.
void outline(const FlatGrid& grid, const Components& components, int component, const std::vector<int>& members,
             CloudPlaneOptions::Outline kind, CloudPlane& plane);

}  // namespace omnimapper::perception::clouds
