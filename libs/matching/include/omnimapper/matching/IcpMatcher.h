#pragma once

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/math/TPose2D.h>
#include <omnimapper/base/OptionTable.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace omnimapper::matching {

enum class IcpMethod { classic, levenberg_marquardt };

struct IcpOptions {
  IcpMethod method = IcpMethod::classic;
  double max_distance = 0.5;                                      ///< [m] of a pair in the first iterations
  double min_distance = 0.1;                                      ///< [m] of a pair in the last iterations
  double max_angle = 2.0 * base::option_text::kRadiansPerDegree;  ///< [rad]; widens the distance far from the sensor
  int max_iterations = 60;
  int decimation = 1;  ///< every n-th point is paired

  static const base::OptionTable<IcpOptions>& table();
};

/// What a match found.
struct ScanMatch {
  mrpt::math::TPose2D reference_from_scan;  ///< [m] [rad]
  double overlap = 0;                       ///< share of the scan's points that have a partner, [0, 1]
  double mean_distance = 0;                 ///< [m] of the partners' distances
  /// Of the pose, in the scan's frame (x y yaw), were each partner good to 1 m: scale by the variance of a point [m2].
  /// Directions the walls do not fix have large entries.
  Eigen::Matrix3d unit_covariance;
};

/// Registers 2D scans with MRPT's iterative closest point (mrpt::slam::CICP; Besl and McKay 1992).
class IcpMatcher {
 public:
  explicit IcpMatcher(const IcpOptions& options);
  ~IcpMatcher();

  /// Both clouds in frames of their own, z ignored; `guess` is where the scan's frame is thought to be in the
  /// reference's. A match without overlap says so by overlap = 0.
  ScanMatch match(const mrpt::maps::CSimplePointsMap& reference, const mrpt::maps::CSimplePointsMap& scan,
                  const mrpt::math::TPose2D& guess) const;

 private:
  struct Icp;
  std::unique_ptr<Icp> icp_;
  IcpOptions options_;
};

}  // namespace omnimapper::matching
