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
  int clutter = 8;                           ///< poles, legs and boxes too small for a line that stand in the room
  double lost = 0.01;                        ///< share of beams without an echo
  double mixed = 0.3;  ///< share of the beams beside a step in depth that tell something between both depths
  double gap = 0.5, shortest = 0.4;  ///< [m] what is one line, and what is none, as in LaserLineOptions
  int fewest = 6;                    ///< beams
};

/// A scan in a room with corners, niches and clutter, and the walls that it shows.
struct LineScan {
  struct Wall {
    geometry::Segment2 seen;  ///< [m] in the frame of the sensor, in the order of the beams
    bool is_long;             ///< as seen, long and dense enough to be looked for
  };
  mrpt::obs::CObservation2DRangeScan scan;
  std::vector<Wall> walls;
};

LineScan drawLineScan(const LineScanOptions& options, Dice& dice);

/// How well lines that were found are the walls of scans; adds up over scans.
struct LineScore {
  int walls = 0, found_walls = 0, lines = 0, right_lines = 0;
  std::vector<double> end_errors;  ///< [m] of both ends of the walls that were found

  /// A line is right that lies along a wall: by 2 degrees, by 3 cm in its middle, with most of its length beside it. A
  /// wall is found where one of these has at least half of the wall and half of the two together.
  void add(const LineScan& truth, const std::vector<geometry::Segment2>& found);
  double recall() const { return walls > 0 ? double(found_walls) / walls : 1; }
  double precision() const { return lines > 0 ? double(right_lines) / lines : 1; }
  double meanEndError() const;
};

}  // namespace omnimapper::testing
