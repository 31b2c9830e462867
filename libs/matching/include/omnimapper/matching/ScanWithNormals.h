#pragma once

#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::matching {

/// Points of a 2D scan, or of several, with the normals of the walls on which they lie [m]. Each point was moved onto
/// the line fitted to its neighbours, so that a noisy wall is as thin as a clean wall.
struct ScanWithNormals {
  std::vector<Eigen::Vector2f> points;
  std::vector<Eigen::Vector2f> normals;  ///< one for each point: unit, either sign; zero where no line fits
  float smoothing = 1;                   ///< average number of points that a line was fitted to

  std::size_t size() const { return points.size(); }
  bool empty() const { return points.empty(); }
};

/// Fits a line around each point. `points` are in the order of the beams. Each point's window of neighbours grows until
/// a line fits, given the noise estimated from the scan itself, so that clean corners stay sharp and noisy walls become
/// straight.
ScanWithNormals fitLines(const std::vector<Eigen::Vector2f>& points);

/// Appends `scan`, moved by target_from_scan, to `target`.
void append(const ScanWithNormals& scan, const mrpt::math::TPose2D& target_from_scan, ScanWithNormals& target);

/// Keeps the first point of each square cell of `side` [m], so that a place that many scans saw counts once.
ScanWithNormals voxelDownsample(const ScanWithNormals& scan, double side);

}  // namespace omnimapper::matching
