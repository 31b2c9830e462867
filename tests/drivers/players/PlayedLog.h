#pragma once

#include <mrpt/math/TTwist2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose2D.h>
#include <omnimapper/base/Stamp.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::players {

/// One reading of wheel odometry, as a robot's own program would send it.
struct OdometryReading {
  base::Stamp log;                               ///< its stamp in the log
  mrpt::poses::CPose2D odom_from_base;           ///< [m, rad] cumulative
  std::optional<mrpt::math::TTwist2D> velocity;  ///< of the base in its own frame [m/s, rad/s]
};

/// The data of a log that can be played.
struct PlayedLog {
  using Scans = std::vector<mrpt::obs::CObservation2DRangeScan::Ptr>;

  std::map<std::string, Scans> lasers;    ///< by label, each by rising stamp
  std::vector<OdometryReading> odometry;  ///< by rising stamp

  /// Takes scans and odometry from these; motions (CObservationRelativeMotion) are added up if there is no other
  /// odometry. An observation whose stamp is not later than that of the one before is left out.
  static PlayedLog of(const std::vector<mrpt::obs::CObservation::Ptr>& observations);
  /// Throws as source::RawlogSource.
  static PlayedLog read(const std::string& rawlog);
  /// The earliest stamp of all scans and odometry. Throws Error(unreadable_input) if there is nothing to play.
  base::Stamp start() const;
};

}  // namespace omnimapper::players
