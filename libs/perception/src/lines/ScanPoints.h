#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/perception/LaserLineExtractor.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace omnimapper::perception::lines {

/// A 2D line, n . p = distance: n is a unit vector, distance >= 0 [m].
struct Line {
  double nx = 1, ny = 0, distance = 0;
};

/// Largest spacing of beams on a wall, relative to that on a wall that faces them; reached at an incidence of 87
/// degrees.
inline constexpr double kSteepestWall = 20;

/// The valid beams of a scan, in their order, with one array for each quantity.
struct ScanPoints {
  std::vector<double> ux, uy;  ///< unit, direction of the beam
  std::vector<double> x, y;    ///< [m]
  std::vector<double> range;   ///< [m]
  /// The variance of a point across a line with normal n is across + steep (n . u)^2 [m^2]: the noise of the range
  /// counts by how squarely the beam meets the line, the width of the beam by how obliquely.
  std::vector<double> across, steep;
  std::vector<int> beam;   ///< index in the scan
  int beams = 0;           ///< number of beams of the scan, invalid ones included
  double step = 0;         ///< [rad] between two beams
  bool all_round = false;  ///< the last beam is next to the first

  int size() const { return static_cast<int>(x.size()); }
  double variance(int i, const Line& line) const {
    const double facing = line.nx * ux[i] + line.ny * uy[i];
    return across[i] + steep[i] * facing * facing;
  }
  double offset(int i, const Line& line) const { return line.nx * x[i] + line.ny * y[i] - line.distance; }
  /// Squared distance from a line, in standard deviations.
  double chiSquare(int i, const Line& line) const {
    const double off = offset(i, line);
    return off * off / variance(i, line);
  }
  /// Whether a line on which point j follows point i is split between them. Neighbouring beams never split it, however
  /// far apart they meet the wall, since nothing was measured between them; if one beam is missing, which may have
  /// failed, the gap may be twice as long.
  bool isGap(int i, int j, double max_gap) const {
    const int between = beamsBetween(i, j);
    return between > 0 && distanceBetween(i, j) > (between == 1 ? 2 * max_gap : max_gap);
  }
  /// Whether points i and j, with none between them, could be on one wall only if it pointed at the sensor: one is then
  /// on an object and the other on what is behind it.
  bool isBehind(int i, int j, double max_gap) const {
    const double distance = distanceBetween(i, j);
    const double facing = step * (beamsBetween(i, j) + 1) * std::min(range[i], range[j]);
    return distance > max_gap && distance > kSteepestWall * facing;
  }
  int beamsBetween(int i, int j) const { return beam[j] - beam[i] + (beam[j] < beam[i] ? beams : 0) - 1; }
  double distanceBetween(int i, int j) const { return std::hypot(x[i] - x[j], y[i] - y[j]); }
};

ScanPoints pointsOf(const mrpt::obs::CObservation2DRangeScan& scan, const LaserLineOptions& options);

/// The same points in cyclic order, with the one at `start` first.
ScanPoints startingAt(ScanPoints points, int start);

/// Points first..last, which are on one line except for some outliers.
struct Stretch {
  int first = 0, last = 0;
  Line line;
};

}  // namespace omnimapper::perception::lines
