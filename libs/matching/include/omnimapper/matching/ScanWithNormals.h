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
  /// One for each point: the number of the thing to which it belongs, or kNoThing (numberThings() in Things.h). Empty
  /// where the things were not numbered.
  std::vector<int> things;
  /// One for each point: how much the point counts in a match, [0, 1]. Empty: all count 1.
  std::vector<float> weights;
  float smoothing = 1;  ///< average number of points that a line was fitted to

  static constexpr int kNoThing = -1;

  std::size_t size() const { return points.size(); }
  bool empty() const { return points.empty(); }
};

/// Standard deviation of the noise of a scan along its beams [m]; 0 for fewer than three points. `points` are in the
/// order of the beams.
float rangeNoise(const std::vector<Eigen::Vector2f>& points);

/// Fits a line around each point. `points` are in the order of the beams. Each point's window of neighbours grows until
/// a line fits, given the noise estimated from the scan itself, so that clean corners stay sharp and noisy walls become
/// straight.
ScanWithNormals fitLines(const std::vector<Eigen::Vector2f>& points);

/// The points for which `dropped` is false, with all that is known of them.
ScanWithNormals without(const std::vector<bool>& dropped, const ScanWithNormals& scan);

/// Marks also four neighbours on each side of a marked point, as far as no gap of more than 0.6 m is between them:
/// their lines may have been fitted to that point, too.
std::vector<bool> withNeighbours(std::vector<bool> marked, const ScanWithNormals& scan);

/// Appends the points and normals of `scan`, moved by target_from_scan, to `target`.
void append(const ScanWithNormals& scan, const mrpt::math::TPose2D& target_from_scan, ScanWithNormals& target);

/// Keeps the first point of each square cell of `side` [m], so that a place that many scans saw counts once.
ScanWithNormals voxelDownsample(const ScanWithNormals& scan, double side);

}  // namespace omnimapper::matching
