#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/matching/PlanarScan.h>

#include <Eigen/Core>

#include "PointIndex.h"

namespace omnimapper::matching {

/// Point-to-line normal equations of all points of a scan that have a partner in a reference, at one pose.
struct LinePartners {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of x y yaw in the scan's frame, unit variance a point
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double squared_distance = 0, weight = 0;  ///< of the points on lines
  double squared_radius = 0;                ///< [m2] of the points on lines from the scan's origin, weighted
  std::size_t near = 0;                     ///< points with any partner

  /// [m] Root mean square across the lines.
  double wallDistance() const;
};

/// `max_distance` [m] of a partner; `loss_scale` [m] of the Cauchy weight.
LinePartners findPartners(const PointIndex& reference, const PlanarScan& scan, const mrpt::math::TPose2D& pose,
                          double max_distance, double loss_scale);

/// Which directions the partners fix, as a change of basis in which x y yaw count alike.
class FixedDirections {
 public:
  explicit FixedDirections(const LinePartners& partners);
  bool all() const { return count_ == 3; }
  /// The Gauss-Newton step of the partners, and of a guess that knows so much and is that far away. Along directions
  /// that the partners do not fix the guess alone counts; zero where it knows nothing either.
  Eigen::Vector3d step(const Eigen::Vector3d& gradient, const Eigen::Matrix3d& guess_information,
                       const Eigen::Vector3d& from_guess) const;
  /// Open directions have variance ScanMatch::kOpen.
  Eigen::Matrix3d covariance() const;

 private:
  Eigen::Matrix3d basis_;  // columns: directions, scaled
  Eigen::Vector3d fixed_;  // the information along them; 0 where open
  int count_ = 0;
};

}  // namespace omnimapper::matching
