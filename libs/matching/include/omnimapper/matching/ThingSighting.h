#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/matching/ScanWithNormals.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

namespace omnimapper::matching {

/// A thing as one scan saw it, in the frame of the track.
struct ThingSighting {
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();  ///< [m]
  std::vector<Eigen::Vector2f> points;               ///< [m]
  double seconds = 0;                                ///< time of the scan
  std::size_t begin = 0;                             ///< the first of its points in the scan
  Eigen::Vector2f viewer = Eigen::Vector2f::Zero();  ///< [m] position of the laser
};

/// Takes a point of a scan into the frame of the track.
class ToTrack {
 public:
  explicit ToTrack(const mrpt::math::TPose2D& track_from_scan)
      : origin_(static_cast<float>(track_from_scan.x), static_cast<float>(track_from_scan.y)),
        cos_(static_cast<float>(std::cos(track_from_scan.phi))),
        sin_(static_cast<float>(std::sin(track_from_scan.phi))) {}
  Eigen::Vector2f operator()(const Eigen::Vector2f& p) const {
    return {origin_.x() + cos_ * p.x() - sin_ * p.y(), origin_.y() + sin_ * p.x() + cos_ * p.y()};
  }

 private:
  Eigen::Vector2f origin_;
  float cos_, sin_;
};

/// The things of a scan by its `things`, the points of each of which follow one another. `sensor`: position of the
/// laser in the scan's frame [m].
std::vector<ThingSighting> sightingsIn(const mrpt::math::TPose2D& track_from_scan, const Eigen::Vector2f& sensor,
                                       double seconds, const ScanWithNormals& scan);

/// The mean of points, of which there must be one [m].
Eigen::Vector2f centreOf(const std::vector<Eigen::Vector2f>& points);
/// The diagonal of the box along the axes that holds all points, of which there must be one [m].
float extentOf(const std::vector<Eigen::Vector2f>& points);
/// The number of points that lie within 0.1 m of others.
std::size_t overlapping(const std::vector<Eigen::Vector2f>& points, const std::vector<Eigen::Vector2f>& others);

}  // namespace omnimapper::matching
