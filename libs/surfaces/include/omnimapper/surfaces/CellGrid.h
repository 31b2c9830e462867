#pragma once

#include <omnimapper/geometry/Plane3.h>

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace omnimapper::surfaces {

/// A rectangle of square cells on a plane. Some cells are set: for example those where a surface was seen, or those
/// that an outline covers.
class CellGrid {
 public:
  /// A cell by column (along u) and row (along v).
  struct Cell {
    int column = 0, row = 0;
  };

  CellGrid() = default;
  /// `u` and `v` are unit vectors at right angles. Cell (0, 0) reaches from its corner at `origin` to the opposite
  /// corner at origin + cell * (u + v) [m]. Throws std::invalid_argument unless cell > 0, both counts are in [0,
  /// 100000], and there are at most 100 million cells.
  CellGrid(const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v, double cell, int columns,
           int rows);
  /// The grid that covers the given points of a plane, with no cell set. If the plane is not level, u is along the
  /// floor and v up; on a level plane u is along x.
  static CellGrid around(const geometry::Plane3& plane, const std::vector<Eigen::Vector3d>& points, double cell);

  /// This grid or, if points lie outside of it, a larger grid that also covers these points, with the same cells set.
  /// An empty grid gives around(). `plane` and `cell` must be those of this grid.
  CellGrid grownTo(const geometry::Plane3& plane, std::vector<Eigen::Vector3d> points, double cell) const;
  /// The same cells in frame b.
  CellGrid movedBy(const geometry::Se3& b_from_a) const;

  const Eigen::Vector3d& origin() const { return origin_; }
  const Eigen::Vector3d& u() const { return u_; }
  const Eigen::Vector3d& v() const { return v_; }
  double cell() const { return cell_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double areaOfCell() const { return cell_ * cell_; }

  /// The cell that contains the projection of a point; none outside of the grid.
  std::optional<Cell> cellAt(const Eigen::Vector3d& point) const;
  Eigen::Vector3d middleOf(Cell cell) const;
  bool isSet(Cell cell) const { return cells_[indexOf(cell)]; }
  void set(Cell cell) { cells_[indexOf(cell)] = true; }
  /// Sets the cells whose middle is inside the outline and outside the holes, by the even-odd rule. Outline and holes
  /// are projected to the plane.
  void fill(const std::vector<Eigen::Vector3d>& outline, const std::vector<std::vector<Eigen::Vector3d>>& holes = {});
  std::size_t count() const;
  double area() const { return areaOfCell() * static_cast<double>(count()); }  ///< of the cells that are set [m^2]

 private:
  std::size_t indexOf(Cell cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(cell.column);
  }

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero(), u_ = Eigen::Vector3d::UnitX(), v_ = Eigen::Vector3d::UnitY();
  double cell_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<bool> cells_;
};

}  // namespace omnimapper::surfaces
