#pragma once

#include <omnimapper/source/ObservationSource.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::source {

/// Which odometry of a CARMEN log gets the label ODOM, which comes first in the stream and which a mapper uses. Such a
/// log holds the odometry twice: in ODOM lines with their own stamps, and again in each scan's line, which repeats the
/// last ODOM line, however old that is. The odometry of a scan is handed out right before the scan, with its stamp.
enum class CarmenOdometry {
  automatic,  ///< `lines` if the log has ODOM lines and no stamp runs backwards, else `scans`
  lines,      ///< ODOM lines are ODOM, better if the log's clock is good; odometry of scans is <scan's label>_ODOM
  scans,      ///< the odometry of scans is ODOM; ODOM lines are left out
};

/// Streams a CARMEN log (plain, gzip or bzip2) as MRPT observations: CObservation2DRangeScan for FLASER, RLASER,
/// ROBOTLASER1 and ROBOTLASER2, labelled with these names, and CObservationOdometry.
///
/// Stamps are the log's IPC stamps, the third field from the end. Lines are in the order of capture but stamps need not
/// be, so the stamps of each label are repaired: t'_i = max(t_i, t'_(i-1) + 1 ms).
/// A ROBOTLASER line describes its beams itself. The beams of FLASER and RLASER are described by the log's PARAM lines
/// (laser_front_laser_resolution and _fov [deg], robot_front_laser_max [m], robot_frontlaser_offset and _side_offset
/// [m], _angular_offset [rad], and the same with rear). Without these the laser is taken for a SICK at the base: 180
/// beams from -90 to +89 deg, or 181 to +90 deg, counter-clockwise; the rear one looks back. Readings of 80 m and more
/// count as no echo.
class CarmenLog : public ObservationSource {
 public:
  /// Throws Error(unreadable_input) if the file cannot be opened or is no CARMEN log.
  explicit CarmenLog(const std::string& path, CarmenOdometry odometry = CarmenOdometry::automatic);
  ~CarmenLog() override;

  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  /// `objects` counts lines; `other_objects` counts lines that are not used, by their first word.
  SourceReport report() const override;

  /// The choice that was made; never `automatic`.
  CarmenOdometry odometry() const;

  struct BadLine {
    std::uint64_t number;  ///< from 1
    std::string reason;
  };
  std::uint64_t badLineCount() const;
  /// The first ten bad lines.
  const std::vector<BadLine>& badLines() const;
  /// Odometry readings left out: those of the kind that was not chosen, those not later than the reading before them,
  /// and those of scans before the first ODOM.
  std::uint64_t unusedOdometry() const;

 private:
  class Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace omnimapper::source
