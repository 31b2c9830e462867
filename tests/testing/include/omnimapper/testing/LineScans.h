#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/geometry/Segment2.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <vector>

namespace omnimapper::testing {

struct LineScanOptions {
  int beams = 181;
  double aperture = 3.14159265358979323846;  ///< [rad]
  double max_range = 20;                     ///< [m]
  double sigma = 0.01;                       ///< [m] of a range
  int clutter = 8;                   ///< number of poles, legs and boxes in the room that are too small for a line
  double lost = 0.01;                ///< share of beams without an echo
  double mixed = 0.3;                ///< share of the beams at a step in depth that measure a range between both sides
  double gap = 0.5, shortest = 0.4;  ///< [m] largest gap in a line, least length of a line, as in LaserLineOptions
  int fewest = 6;                    ///< least number of beams on a line
};

/// A scan in a room with corners, niches and clutter, and the walls that are visible in it.
struct LineScan {
  struct Wall {
    geometry::Segment2 visible;  ///< [m] visible part in the frame of the sensor, in the order of the beams
    bool is_long;                ///< whether the visible part is long and dense enough to be detected
  };
  mrpt::obs::CObservation2DRangeScan scan;
  std::vector<Wall> walls;
};

LineScan drawLineScan(const LineScanOptions& options, Dice& dice);

/// Compares detected lines with the walls of scans. Results are summed over scans.
struct LineScore {
  int walls = 0, found_walls = 0, lines = 0, right_lines = 0;
  std::vector<double> end_errors;  ///< [m] errors of both ends of the walls that were found

  /// A line is right if it is within 2 degrees of a wall, its middle is within 3 cm of it, and most of its length is
  /// beside it. A wall is found if a right line overlaps with at least half of the wall and half of their union.
  void add(const LineScan& truth, const std::vector<geometry::Segment2>& found);
  double recall() const { return walls > 0 ? double(found_walls) / walls : 1; }
  double precision() const { return lines > 0 ? double(right_lines) / lines : 1; }
  double meanEndError() const;
};

}  // namespace omnimapper::testing
