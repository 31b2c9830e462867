#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/matching/PlanarScan.h>

#include <Eigen/Core>
#include <memory>

namespace omnimapper::matching {

enum class IcpMethod { classic, levenberg_marquardt };

struct IcpOptions {
  IcpMethod method = IcpMethod::classic;
  double max_distance = 0.5;                                      ///< [m] of a pair in the first iterations
  double min_distance = 0.1;                                      ///< [m] of a pair in the last iterations
  double max_angle = 2.0 * base::option_text::kRadiansPerDegree;  ///< [rad]; widens the distance far from the sensor
  int max_iterations = 40;
  int decimation = 3;                ///< every n-th point is paired
  int refinements = 10;              ///< point-to-line iterations after it; 0: none
  double refinement_distance = 0.3;  ///< [m] of a pair in them

  static const base::OptionTable<IcpOptions>& table();
};

/// What a match found.
struct ScanMatch {
  mrpt::math::TPose2D reference_from_scan;  ///< [m] [rad]
  double overlap = 0;                       ///< share of the scan's points that have a partner on a wall, [0, 1]
  double wall_distance = 0;                 ///< [m] root mean square of the partners' distances across the walls
  /// Of the pose, in the scan's frame (x y yaw), were each partner good to 1 m: scale by the variance of a point [m2].
  /// Directions the walls do not fix have large entries.
  Eigen::Matrix3d unit_covariance;
};

/// Registers 2D scans with MRPT's iterative closest point (mrpt::slam::CICP; Besl and McKay 1992), then refines the
/// pose by the distances of points to walls (Chen and Medioni 1991), which is not drawn along the walls by sampling.
class IcpMatcher {
 public:
  explicit IcpMatcher(const IcpOptions& options);
  ~IcpMatcher();

  /// `guess` is where the scan's frame is thought to be in the reference's. A match without overlap says so by
  /// overlap = 0.
  ScanMatch match(const PlanarScan& reference, const PlanarScan& scan, const mrpt::math::TPose2D& guess) const;

 private:
  struct Icp;
  std::unique_ptr<Icp> icp_;
  IcpOptions options_;
};

}  // namespace omnimapper::matching
