#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/matching/ScanWithNormals.h>

#include <Eigen/Core>
#include <memory>

namespace omnimapper::matching {

/// Result of a match.
struct ScanMatch {
  mrpt::math::TPose2D reference_from_scan;  ///< [m] [rad]
  double overlap = 0;                       ///< share of the scan's points that have a correspondence, [0, 1]
  double wall_distance = 0;  ///< [m] root mean square distance of points from the walls that they correspond to
  /// Covariance of the pose, in the scan's frame (x y yaw), if each point of weight 1 had a standard deviation of 1 m:
  /// multiply it by the variance of a point [m2]. Along a direction that the walls do not constrain, the pose stays at
  /// the guess, and the variance is kOpen.
  Eigen::Matrix3d unit_covariance = kOpen * Eigen::Matrix3d::Identity();
  /// [m] Standard deviation of a point that gives a realistic covariance of the pose: the distance of points from the
  /// walls, enlarged because the errors of neighbouring points are not independent (their normals were fitted to the
  /// same points).
  double point_sigma = 0;
  /// Whether the walls leave a direction of the pose unconstrained: in a bare corridor, at a single wall, in a round
  /// room, or without any correspondences.
  bool degenerate = true;

  static constexpr double kOpen = 1e6;
};

/// Initial pose of a scan.
struct MatchGuess {
  MatchGuess(const mrpt::math::TPose2D& pose = {}, const Eigen::Matrix3d& known = Eigen::Matrix3d::Zero())
      : reference_from_scan(pose), information(known) {}

  mrpt::math::TPose2D reference_from_scan;  ///< [m] [rad]
  /// Weight of this pose relative to the points: inverse covariance in the scan's frame (x y yaw), times the variance
  /// of a point [m2]. If it is zero, the pose is only where the search begins.
  Eigen::Matrix3d information;
};

/// Points that scans are matched against, prepared for the search of correspondences. Immutable.
class MatchReference {
 public:
  virtual ~MatchReference() = default;
};

/// Registers 2D scans, in the plane. Const functions may be called from several threads.
class ScanMatcher {
 public:
  virtual ~ScanMatcher() = default;
  virtual std::shared_ptr<const MatchReference> prepare(ScanWithNormals reference) const = 0;
  /// `reference` must come from prepare() of a matcher of this class. A match without correspondences has overlap = 0
  /// and the pose of the guess. The covariance is that of the points alone, without the information of the guess.
  virtual ScanMatch match(const MatchReference& reference, const ScanWithNormals& scan,
                          const MatchGuess& guess) const = 0;
};

}  // namespace omnimapper::matching
