#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/matching/ScanWithNormals.h>

#include <Eigen/Core>
#include <memory>

namespace omnimapper::matching {

/// What a match found.
struct ScanMatch {
  mrpt::math::TPose2D reference_from_scan;  ///< [m] [rad]
  double overlap = 0;                       ///< share of the scan's points that have a partner, [0, 1]
  double wall_distance = 0;                 ///< [m] root mean square of the partners' distances across the walls
  /// Of the pose, in the scan's frame (x y yaw), were each partner good to 1 m: scale by the variance of a point [m2].
  /// Along a direction that the walls do not fix the pose stays where it was guessed, and the variance is kOpen.
  Eigen::Matrix3d unit_covariance = kOpen * Eigen::Matrix3d::Identity();
  /// [m] Standard deviation of a point that makes an honest covariance of the pose: of the distances from the walls,
  /// and of how many neighbours share one error because their line was fitted to the same points.
  double point_sigma = 0;
  /// Whether there is such a direction: a bare corridor, a single wall, a round room, or no partners at all.
  bool degenerate = true;

  static constexpr double kOpen = 1e6;
};

/// Where a scan is thought to be.
struct MatchGuess {
  MatchGuess(const mrpt::math::TPose2D& pose = {}, const Eigen::Matrix3d& known = Eigen::Matrix3d::Zero())
      : reference_from_scan(pose), information(known) {}

  mrpt::math::TPose2D reference_from_scan;  ///< [m] [rad]
  /// How much that counts beside the points: inverse covariance in the scan's frame (x y yaw), times the variance of a
  /// point [1]. Zero: it is where the search begins, and no more.
  Eigen::Matrix3d information;
};

/// What scans are matched against: points prepared for the search of partners. Immutable.
class MatchReference {
 public:
  virtual ~MatchReference() = default;
};

/// Registers 2D scans, in the plane. Const functions may be called from several threads.
class ScanMatcher {
 public:
  virtual ~ScanMatcher() = default;
  virtual std::shared_ptr<const MatchReference> prepare(ScanWithNormals reference) const = 0;
  /// `reference` from prepare() of a matcher of this class. A match without partners says so by overlap = 0, and leaves
  /// the guess as it is. The covariance is that of the points alone, without what the guess knew.
  virtual ScanMatch match(const MatchReference& reference, const ScanWithNormals& scan,
                          const MatchGuess& guess) const = 0;
};

}  // namespace omnimapper::matching
