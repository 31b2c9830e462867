#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/matching/ScanWithNormals.h>

#include <Eigen/Core>
#include <vector>

#include "PointIndex.h"

namespace omnimapper::matching {

/// Point-to-line normal equations at one pose, of the points of a scan that have a correspondence in a reference.
struct LineEquations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of x y yaw in the scan's frame, for unit variance
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double squared_distance = 0, weight = 0;  ///< sums over the points on lines
  double squared_radius = 0;  ///< [m2] weighted sum of the squared distances of all points from the scan's origin

  /// [m] Root mean square distance across the lines.
  double wallDistance() const;
};

/// The points of a scan, each with its nearest point of a reference.
class Correspondences {
 public:
  /// Both arguments must outlive this object.
  Correspondences(const PointIndex& reference, const ScanWithNormals& scan);

  /// Finds the correspondences within `max_distance` [m] anew.
  void find(const mrpt::math::TPose2D& reference_from_scan, double max_distance);
  /// Number of points with a correspondence.
  std::size_t count() const { return count_; }
  /// [m] The distance across the lines that is larger than a share `share` of them.
  double quantile(const mrpt::math::TPose2D& reference_from_scan, double share) const;
  /// `loss_scale` [m] of the Cauchy weight. `point_weight`: weight of the whole distance of correspondences without a
  /// line; `along`: weight of the whole distance of the others, in addition to that across their lines. The weights of
  /// the scan's points count only after weighPoints().
  LineEquations equations(const mrpt::math::TPose2D& reference_from_scan, double loss_scale, double point_weight,
                          double along) const;
  /// From now on each point counts by its weight in the scan. Returns whether that makes a difference.
  bool weighPoints();

 private:
  const PointIndex& reference_;
  const ScanWithNormals& scan_;
  std::vector<int> likely_;  // of each point, from the last search
  using Values = std::vector<float>;
  bool weighed_ = false;
  // For each point with a correspondence, padded to a whole number of lanes: the point of the scan, the point of the
  // reference, its normal, and its weight for a reference with and without a line (0 in one of them).
  Values px_, py_, qx_, qy_, nx_, ny_, on_line_, on_point_;
  std::vector<std::size_t> index_;  // of the point in the scan
  mutable Values scratch_;
  std::size_t count_ = 0;
};

/// The directions that the correspondences constrain, in a basis in which x, y and yaw have the same scale.
class ObservableSubspace {
 public:
  /// Directions that get less than `noise_share` of all information count as open.
  explicit ObservableSubspace(const LineEquations& equations, double noise_share = kNoiseShare);
  /// Normals are accurate to some 6 degrees, so a direction that gets less than the square of that (in radians) of all
  /// information is constrained by noise alone.
  static constexpr double kNoiseShare = 0.01;
  bool all() const { return count_ == 3; }
  /// The part of a small motion that is not along open directions.
  Eigen::Vector3d observablePart(const Eigen::Vector3d& motion) const;
  /// The Gauss-Newton step of these equations and of a guess with `guess_information`, which lies `from_guess` away.
  /// Along open directions only the guess counts; the step is zero there if it has no information either.
  Eigen::Vector3d step(const LineEquations& equations, const Eigen::Matrix3d& guess_information,
                       const Eigen::Vector3d& from_guess) const;
  /// Open directions have variance ScanMatch::kOpen.
  Eigen::Matrix3d covariance() const;

 private:
  Eigen::Matrix3d basis_;        // columns: directions, scaled
  Eigen::Vector3d information_;  // the information along them; 0 where open
  int count_ = 0;
};

}  // namespace omnimapper::matching
