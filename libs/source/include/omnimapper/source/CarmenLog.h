#pragma once

#include <omnimapper/source/ObservationSource.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::source {

/// A CARMEN log holds the odometry twice: in ODOM lines with stamps of their own, and again in each scan's line, where
/// it is the last ODOM line's, however old that is. Each scan's odometry is handed out with the scan's stamp, right
/// before the scan. The label ODOM, which comes first and is what a mapper takes, goes to one of the two.
enum class CarmenOdometry {
  automatic,  ///< lines if there are some and no stamp of the log runs backwards, else scans
  lines,      ///< ODOM lines as ODOM: the better one if the log's clock is good; those of scans as <scan's label>_ODOM
  scans,      ///< those of the scans as ODOM; ODOM lines are left out
};

/// Streams a CARMEN log (plain, gzip or bzip2) as MRPT observations: CObservation2DRangeScan for FLASER, RLASER,
/// ROBOTLASER1 and ROBOTLASER2, labelled with these names, and CObservationOdometry.
///
/// Stamps are the log's IPC stamps, the third field from the end. The lines stand in the order of capture, the stamps
/// need not: for each label t'_i = max(t_i, t'_(i-1) + 1 ms).
/// Beams: of a ROBOTLASER line its own; of FLASER and RLASER the log's PARAM lines (laser_front_laser_resolution and
/// _fov [deg], robot_front_laser_max [m], robot_frontlaser_offset and _side_offset [m], _angular_offset [rad], and the
/// same with rear), else a SICK at the base: 180 beams from -90 to +89 deg, or 181 to +90, counter-clockwise; the rear
/// one looks back. Readings from 80 m on are no echo.
class CarmenLog : public ObservationSource {
 public:
  /// Throws Error(unreadable_input) if the file cannot be opened or is no CARMEN log.
  explicit CarmenLog(const std::string& path, CarmenOdometry odometry = CarmenOdometry::automatic);
  ~CarmenLog() override;

  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  /// Objects are lines; other_objects are lines of no interest, by their first word.
  SourceReport report() const override;

  /// automatic, resolved.
  CarmenOdometry odometry() const;

  struct BadLine {
    std::uint64_t number;  ///< from 1
    std::string reason;
  };
  std::uint64_t badLineCount() const;
  /// The first ten.
  const std::vector<BadLine>& badLines() const;
  /// Odometry left out: of the kind not chosen, or not later than the odometry before it.
  std::uint64_t unusedOdometry() const;

 private:
  class Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace omnimapper::source
