#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/perception/LaserLineExtractor.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace omnimapper::perception::lines {

/// A line of the plane: n . p = distance with n unit, distance >= 0 [m].
struct Line {
  double nx = 1, ny = 0, distance = 0;
};

/// How much farther apart beams meet a wall than one that faces them, at the most: at 87 degrees.
inline constexpr double kSteepestWall = 20;

/// The beams of a scan that met something, in their order, one array for each number.
struct ScanPoints {
  std::vector<double> ux, uy;  ///< unit, direction of the beam
  std::vector<double> x, y;    ///< [m]
  std::vector<double> range;   ///< [m]
  /// The square of a point's deviation from a line with normal n, across it [m^2], is across + steep (n . u)^2: a range
  /// counts as far as the beam is square to the line, the beam's width as far as it is along it.
  std::vector<double> across, steep;
  std::vector<int> beam;   ///< index in the scan
  int beams = 0;           ///< of the scan
  double step = 0;         ///< [rad] between two beams
  bool all_round = false;  ///< the last beam is next to the first

  int size() const { return static_cast<int>(x.size()); }
  double variance(int i, const Line& line) const {
    const double facing = line.nx * ux[i] + line.ny * uy[i];
    return across[i] + steep[i] * facing * facing;
  }
  double offset(int i, const Line& line) const { return line.nx * x[i] + line.ny * y[i] - line.distance; }
  /// Squared distance from a line in deviations.
  double chiSquare(int i, const Line& line) const {
    const double off = offset(i, line);
    return off * off / variance(i, line);
  }
  /// Whether a line that has points i < j, and none between them, is two lines. Of two beams side by side nothing is
  /// known in between, however far apart they meet the wall; one beam may fail.
  bool isGap(int i, int j, double max_gap) const {
    const int between = beamsBetween(i, j);
    return between > 0 && distanceBetween(i, j) > (between == 1 ? 2 * max_gap : max_gap);
  }
  /// Whether only a wall that points at the sensor itself could have both, and none between them: those are a thing and
  /// what is behind it.
  bool isBehind(int i, int j, double max_gap) const {
    const double distance = distanceBetween(i, j);
    const double facing = step * (beamsBetween(i, j) + 1) * std::min(range[i], range[j]);
    return distance > max_gap && distance > kSteepestWall * facing;
  }
  int beamsBetween(int i, int j) const { return beam[j] - beam[i] + (beam[j] < beam[i] ? beams : 0) - 1; }
  double distanceBetween(int i, int j) const { return std::hypot(x[i] - x[j], y[i] - y[j]); }
};

ScanPoints pointsOf(const mrpt::obs::CObservation2DRangeScan& scan, const LaserLineOptions& options);

/// The same points, the one at `start` first and those before it last.
ScanPoints startingAt(ScanPoints points, int start);

/// Points first..last that are on one line, but for some that are not.
struct Stretch {
  int first = 0, last = 0;
  Line line;
};

}  // namespace omnimapper::perception::lines
