#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/source/LogLook.h>
#include <omnimapper/source/ObservationSource.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace omnimapper::source {

/// A CARMEN log holds the odometry twice: in ODOM lines with their own stamps, and again in the line of each scan,
/// which repeats the last ODOM line, however old this line is. One of the two gets the label ODOM, and a mapper uses
/// it, because it comes first in the stream. The odometry of a scan is handed out right before the scan, with the
/// scan's stamp.
enum class CarmenOdometry {
  automatic,  ///< `lines` if the log has ODOM lines and no stamp runs backwards, else `scans`
  lines,      ///< ODOM lines get the label ODOM, and scans' odometry <scan's label>_ODOM; better if the clock is good
  scans,      ///< the odometry of scans gets the label ODOM; ODOM lines are left out
};

struct CarmenOptions {
  CarmenOdometry odometry = CarmenOdometry::automatic;
  static const base::OptionTable<CarmenOptions>& table();
};

/// Streams a CARMEN log (plain, gzip or bzip2) as MRPT observations: CObservation2DRangeScan for FLASER, RLASER,
/// ROBOTLASER1 and ROBOTLASER2, labelled with these names, and CObservationOdometry.
///
/// Stamps are the log's IPC stamps, the third field from the end. Lines are in the order of capture but stamps need not
/// be, so the stamps of each label are repaired: t'_i = max(t_i, t'_(i-1) + 1 ms).
/// A ROBOTLASER line describes its beams itself. The beams of FLASER and RLASER are described by the log's PARAM lines
/// (laser_front_laser_resolution and _fov [deg], robot_front_laser_max [m], robot_frontlaser_offset and _side_offset
/// [m], _angular_offset [rad], and the same names with `rear`). Without these lines the laser is taken for a SICK at
/// the base, with beams in counter-clockwise order: 180 beams from -90 to +89 deg, or 181 beams from -90 to +90 deg.
/// The rear laser looks back. Readings of 80 m and more count as no echo.
class CarmenLog : public ObservationSource {
 public:
  static constexpr const char* kName = "carmen_log";
  static constexpr const char* kSummary = "a CARMEN log";
  static bool recognizes(const LogLook& look);

  /// Throws Error(unreadable_input) if the file cannot be opened or is no CARMEN log.
  explicit CarmenLog(const std::string& path, const CarmenOptions& options = {});
  ~CarmenLog() override;

  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  /// `objects` counts lines; `other_objects` counts lines that are not used, by their first word.
  SourceReport report() const override;

  /// The odometry that was chosen; never `automatic`.
  CarmenOdometry odometry() const;

  struct BadLine {
    std::uint64_t number;  ///< from 1
    std::string reason;
  };
  std::uint64_t badLineCount() const;
  /// The first ten bad lines.
  const std::vector<BadLine>& badLines() const;
  /// Number of odometry readings left out: with `scans`, all ODOM lines; with `lines`, the readings of scans before the
  /// first ODOM line; with both, readings of scans that are not later than the reading before them.
  std::uint64_t unusedOdometry() const;

 private:
  class Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace omnimapper::source
