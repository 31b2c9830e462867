#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/grid/BeamScan.h>
#include <omnimapper/grid/LikelihoodPyramid.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace omnimapper::grid {

struct BeamModel {
  double cell = 0.05;                ///< [m]
  double tolerance = 0.3;            ///< [m] length of a beam's last part, in which walls do not count as crossed
  double near_wall = 0.06;           ///< [m] standard deviation of the distance of a beam's end from its wall
  double clutter = 0.02;             ///< likelihood of a beam's end where the map has free space
  double unknown = 0.3;              ///< likelihood of a beam's end where the map is unknown
  double anything = 0.01;            ///< smallest likelihood of a beam
  std::size_t max_cells = 64000000;  ///< a map with more cells is refused; a cell takes 5 bytes
};

/// Counts, for each cell of a map, the beams that ended in the cell (at a wall) and the beams that passed through it
/// (free space). From these counts it computes the likelihood of a scan at a pose. Immutable, so threads may share it.
class HitMissGrid {
 public:
  struct Placed {
    mrpt::math::TPose2D map_from_sensor;
    const BeamScan* scan;
  };

  /// Points must be finite. Throws Error(out_of_range) for scans spread over more than max_cells.
  HitMissGrid(const std::vector<Placed>& scans, const BeamModel& model = {});

  /// Logarithms of the beams' likelihoods, first of the hits, then of the misses. A likelihood is between
  /// BeamModel::anything and 1. That of a hit is the likelihood that no wall is on the beam's path and a wall is at its
  /// end; that of a miss, only that no wall is on the beam's path.
  std::vector<double> logLikelihoods(const BeamScan& scan, const mrpt::math::TPose2D& map_from_sensor) const;
  /// Mean of logLikelihoods(); 0 if there are no beams.
  double logLikelihood(const BeamScan& scan, const mrpt::math::TPose2D& map_from_sensor) const;

 private:
  struct Cell {
    std::uint16_t hits = 0, passes = 0;
  };
  void add(const Placed& placed);
  double beam(const Eigen::Vector2d& from, const Eigen::Vector2d& to, bool hit) const;
  const Cell* at(int x, int y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_ ? &cells_[static_cast<std::size_t>(y) * width_ + x] : nullptr;
  }

  BeamModel model_;
  int width_ = 0, height_ = 0;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  std::vector<Cell> cells_;
  std::unique_ptr<const LikelihoodPyramid> walls_;
};

}  // namespace omnimapper::grid
