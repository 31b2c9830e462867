#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/grid/VoteWindow.h>

#include <vector>

namespace omnimapper::grid {

/// Log-odds of a vote in steps of 0.122. One hit outweighs two beams that pass, so that thin walls stay; a surface
/// between two hits weighs as much as one beam that passes.
constexpr int kHitVote = 9, kSurfaceVote = 4, kPassVote = -4;
/// A cell is occupied above a probability of 0.6 and free below 0.4, so one vote decides a cell.
constexpr int kOccupiedAbove = 3, kFreeBelow = -3;

/// Computes the votes of a scan for the cells of the map's z = 0 plane.
///
/// A beam passes the cells between the sensor and its end, and hits the cell where it ends. A beam that reaches the
/// range limit of the sensor or `max_range` only passes cells, and only where BeamEnds::clears(); an invalid beam does
/// not vote. The cell of the sensor is passed in any case. A scan votes once for a
/// cell, however many beams meet the cell, and a hit takes precedence. If two neighbouring beams meet the same surface,
/// no beam clears a cell on the line between their ends, because beams that graze a wall would clear it between their
/// hits. If both also face the surface and their ends are near each other, the cells between the ends count as wall,
/// too, so that a wall is not a row of dots.
class ScanTracer {
 public:
  /// Beams are cut at `max_range` [m].
  explicit ScanTracer(double max_range) : max_range_(max_range) {}

  /// Votes for cells with sides of `resolution` [m]. They must be taken out of the window before the next call.
  VoteWindow& trace(const mrpt::obs::CObservation2DRangeScan& scan, const mrpt::poses::CPose3D& map_from_sensor,
                    double resolution);

 private:
  struct Beam {
    double x = 0, y = 0;  // [cells] where it ends
    bool is_valid = false, hits = false;
  };
  void place(const mrpt::obs::CObservation2DRangeScan& scan, const mrpt::poses::CPose3D& map_from_sensor,
             double resolution);
  void voteSurfaces(double resolution);

  double max_range_;
  Beam origin_;
  std::vector<Beam> beams_;
  VoteWindow votes_;
};

}  // namespace omnimapper::grid
