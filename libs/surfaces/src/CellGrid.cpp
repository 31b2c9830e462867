#include "omnimapper/surfaces/CellGrid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace omnimapper::surfaces {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Adds the columns at which the edges of a closed polygon cross the middles of rows; crossings[i] is of row
// first_row + i.
void addCrossings(const std::vector<Vector2d>& polygon, int first_row, std::vector<std::vector<double>>& crossings) {
  const double last = first_row + static_cast<double>(crossings.size()) - 1;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double from = std::max(first_row + 0.0, std::floor(std::min(a.y(), b.y()) - 0.5));
    const double to = std::min(last, std::ceil(std::max(a.y(), b.y()) - 0.5));
    for (double row = from; row <= to; ++row) {
      const double middle = row + 0.5;
      if ((a.y() > middle) == (b.y() > middle)) continue;
      crossings[static_cast<std::size_t>(row - first_row)].push_back(a.x() + (b.x() - a.x()) * (middle - a.y()) /
                                                                                 (b.y() - a.y()));
    }
  }
}

}  // namespace

CellGrid::CellGrid(const Vector3d& origin, const Vector3d& u, const Vector3d& v, double cell, int columns, int rows)
    : origin_(origin), u_(u), v_(v), cell_(cell), columns_(columns), rows_(rows) {
  constexpr int kMost = 100'000;
  constexpr double kMostCells = 1e8;
  if (!(cell > 0) || columns < 0 || rows < 0 || columns > kMost || rows > kMost ||
      static_cast<double>(columns) * rows > kMostCells)
    throw std::invalid_argument("a grid needs cells of a positive size, and at most 100 million");
  cells_.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), false);
}

CellGrid CellGrid::around(const geometry::Plane3& plane, const std::vector<Vector3d>& points, double cell) {
  if (points.empty()) return {};
  constexpr double kLevel = 0.9;  // z of the normal of a level plane
  const Vector3d& normal = plane.normal;
  const Vector3d u = std::abs(normal.z()) > kLevel ? Vector3d::UnitY().cross(normal).normalized()
                                                   : Vector3d::UnitZ().cross(normal).normalized();
  const Vector3d v = normal.cross(u);
  Vector2d low = Vector2d::Constant(1e300), high = -low;
  for (const Vector3d& point : points) {
    const Vector2d at(u.dot(point), v.dot(point));
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  // Aligned to multiples of the cell size, so that grids of one plane have their cells in the same places.
  low = (low / cell).array().floor() * cell;
  const Vector2d count = ((high - low) / cell).array().ceil().max(1);
  if (!(count.maxCoeff() < 1e6)) throw std::invalid_argument("it would have too many cells");
  return {-plane.distance * normal + low.x() * u + low.y() * v,
          u,
          v,
          cell,
          static_cast<int>(count.x()),
          static_cast<int>(count.y())};
}

CellGrid CellGrid::grownTo(const geometry::Plane3& plane, std::vector<Vector3d> points, double cell) const {
  if (cells_.empty()) return around(plane, points, cell);
  const bool is_inside =
      std::all_of(points.begin(), points.end(), [&](const Vector3d& point) { return cellAt(point).has_value(); });
  if (is_inside) return *this;
  points.push_back(middleOf({0, 0}));
  points.push_back(middleOf({columns_ - 1, rows_ - 1}));
  CellGrid grown = around(plane, points, cell);
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      if (isSet({column, row}))
        if (const auto there = grown.cellAt(middleOf({column, row}))) grown.set(*there);
  return grown;
}

CellGrid CellGrid::movedBy(const geometry::Se3& b_from_a) const {
  CellGrid moved = *this;
  moved.origin_ = b_from_a * origin_;
  moved.u_ = b_from_a.rotation * u_;
  moved.v_ = b_from_a.rotation * v_;
  return moved;
}

std::optional<CellGrid::Cell> CellGrid::cellAt(const Vector3d& point) const {
  const Vector3d from = point - origin_;
  const double column = std::floor(u_.dot(from) / cell_), row = std::floor(v_.dot(from) / cell_);
  if (!(column >= 0 && column < columns_ && row >= 0 && row < rows_)) return std::nullopt;
  return Cell{static_cast<int>(column), static_cast<int>(row)};
}

Vector3d CellGrid::middleOf(Cell cell) const {
  return origin_ + cell_ * ((cell.column + 0.5) * u_ + (cell.row + 0.5) * v_);
}

void CellGrid::fill(const std::vector<Vector3d>& outline, const std::vector<std::vector<Vector3d>>& holes) {
  // The polygon in units of cells, so that the middle of cell i is at i + 0.5.
  const auto flat = [&](const std::vector<Vector3d>& polygon) {
    std::vector<Vector2d> result;
    for (const Vector3d& point : polygon)
      result.emplace_back(u_.dot(point - origin_) / cell_, v_.dot(point - origin_) / cell_);
    return result;
  };
  // A polygon that is not finite, or too far away to be counted in cells, covers nothing.
  const auto isSomewhere = [](const std::vector<Vector2d>& polygon) {
    constexpr double kFarthest = 1e9;  // cells
    return std::all_of(polygon.begin(), polygon.end(), [](const Vector2d& point) {
      return point.allFinite() && point.cwiseAbs().maxCoeff() < kFarthest;
    });
  };
  std::vector<std::vector<Vector2d>> polygons{flat(outline)};
  if (!isSomewhere(polygons.front())) return;
  for (const auto& hole : holes)
    if (auto polygon = flat(hole); isSomewhere(polygon)) polygons.push_back(std::move(polygon));
  double low = rows_, high = 0;
  for (const Vector2d& point : polygons.front()) {
    low = std::min(low, point.y());
    high = std::max(high, point.y());
  }
  const int first_row = static_cast<int>(std::max(0.0, std::floor(low)));
  const int end_row = static_cast<int>(std::min(rows_ + 0.0, high + 1));
  if (first_row >= end_row) return;
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(end_row - first_row));
  for (const auto& polygon : polygons) addCrossings(polygon, first_row, crossings);
  for (int row = first_row; row < end_row; ++row) {
    auto& of_row = crossings[static_cast<std::size_t>(row - first_row)];
    std::sort(of_row.begin(), of_row.end());
    for (std::size_t i = 0; i + 1 < of_row.size(); i += 2) {
      const int first = static_cast<int>(std::ceil(std::clamp(of_row[i] - 0.5, 0.0, columns_ + 0.0)));
      const int end = static_cast<int>(std::ceil(std::clamp(of_row[i + 1] - 0.5, 0.0, columns_ + 0.0)));
      for (int column = first; column < end; ++column) set({column, row});
    }
  }
}

std::size_t CellGrid::count() const {
  return static_cast<std::size_t>(std::count(cells_.begin(), cells_.end(), true));
}

}  // namespace omnimapper::surfaces
