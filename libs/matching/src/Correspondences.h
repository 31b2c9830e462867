#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/matching/ScanWithNormals.h>

#include <Eigen/Core>
#include <vector>

#include "PointIndex.h"

namespace omnimapper::matching {

/// Point-to-line normal equations of the points of a scan that have a partner in a reference, at one pose.
struct LineEquations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of x y yaw in the scan's frame, unit variance a point
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double squared_distance = 0, weight = 0;  ///< of the points on lines
  double squared_radius = 0;                ///< [m2] of all points from the scan's origin, weighted

  /// [m] Root mean square across the lines.
  double wallDistance() const;
};

/// The points of a scan, each with its nearest point of a reference.
class Correspondences {
 public:
  /// Both must outlive it.
  Correspondences(const PointIndex& reference, const ScanWithNormals& scan);

  /// Finds the partners within `max_distance` [m] anew.
  void find(const mrpt::math::TPose2D& reference_from_scan, double max_distance);
  /// Points with a partner.
  std::size_t count() const { return count_; }
  /// [m] `share` of the distances across the lines are less than that.
  double quantile(const mrpt::math::TPose2D& reference_from_scan, double share) const;
  /// `loss_scale` [m] of the Cauchy weight; `alone`: weight of partners without a line, by their whole distance;
  /// `along`: weight by which that counts of the others too.
  LineEquations equations(const mrpt::math::TPose2D& reference_from_scan, double loss_scale, double alone,
                          double along) const;

 private:
  const PointIndex& reference_;
  const ScanWithNormals& scan_;
  std::vector<int> likely_;  // of each point, from the last search
  using Values = std::vector<float>;
  // Of each point with a partner, filled up to a whole number of lanes: the point in the scan, its partner, the
  // partner's normal, and 1 or 0: on a line, alone.
  Values px_, py_, qx_, qy_, nx_, ny_, on_line_, alone_;
  mutable Values scratch_;
  std::size_t count_ = 0;
};

/// Which directions the partners fix, as a change of basis in which x y yaw count alike.
class ObservableSubspace {
 public:
  /// What gets less than `noise_share` of all information counts as open.
  explicit ObservableSubspace(const LineEquations& equations, double noise_share = kNoiseShare);
  /// Normals are good to some 6 degrees: a direction that gets less than its square of all information gets noise.
  static constexpr double kNoiseShare = 0.01;
  bool all() const { return count_ == 3; }
  /// The part of a small motion that is not along open directions.
  Eigen::Vector3d fixedPart(const Eigen::Vector3d& motion) const;
  /// The Gauss-Newton step of these equations, and of a guess that knows so much and is that far away. Along directions
  /// that are not fixed the guess alone counts; zero where it knows nothing either.
  Eigen::Vector3d step(const LineEquations& equations, const Eigen::Matrix3d& guess_information,
                       const Eigen::Vector3d& from_guess) const;
  /// Open directions have variance ScanMatch::kOpen.
  Eigen::Matrix3d covariance() const;

 private:
  Eigen::Matrix3d basis_;  // columns: directions, scaled
  Eigen::Vector3d fixed_;  // the information along them; 0 where open
  int count_ = 0;
};

}  // namespace omnimapper::matching
