#include "ScanGrid.h"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/geometry/Angle.h>

#include <algorithm>
#include <cmath>

#include "ScanBeams.h"

namespace omnimapper::plugins {

namespace {

using mrpt::maps::COccupancyGridMap2D;

// One hit outweighs two beams that pass, so that thin walls seen at grazing angles stay; one pass alone clears a cell.
constexpr float kHitCertainty = 0.75f, kPassCertainty = 0.62f;
constexpr float kOccupiedAbove = 0.6f, kFreeBelow = 0.4f;
constexpr double kTiltTolerance = 10 * geometry::kPi / 180;

struct Extent {
  double min_x = 1e300, max_x = -1e300, min_y = 1e300, max_y = -1e300;

  bool empty() const { return min_x > max_x; }
  void add(double x, double y) {
    min_x = std::min(min_x, x), max_x = std::max(max_x, x);
    min_y = std::min(min_y, y), max_y = std::max(max_y, y);
  }
  double cells(double resolution) const { return (max_x - min_x) / resolution * ((max_y - min_y) / resolution); }
};

Extent extentOf(const map::Map& map, double max_range) {
  Extent extent;
  for (const map::KeyFrame& frame : map.key_frames) {
    forEachScan(frame, [&](const mrpt::obs::CObservation2DRangeScan& scan) {
      const BeamEnds ends(scan, frame.map_from_base);
      const auto origin = ends.origin();
      for (std::size_t i = 0; i < ends.size(); ++i) {
        if (!ends.valid(i)) continue;
        const auto end = ends.at(i, max_range);
        extent.add(end.x, end.y);
        extent.add(origin.x, origin.y);
      }
    });
  }
  return extent;
}

// MRPT's grid follows whatever a scan calls valid, even to where there are no cells: what is no distance is not valid.
mrpt::obs::CObservation2DRangeScan withoutOddRanges(mrpt::obs::CObservation2DRangeScan scan) {
  for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
    const float range = scan.getScanRange(i);
    if (!std::isfinite(range) || range <= 0) scan.setScanRangeValidity(i, false);
  }
  return scan;
}

COccupancyGridMap2D occupancyOf(const map::Map& map, const Extent& extent, double resolution, double max_range) {
  COccupancyGridMap2D grid(static_cast<float>(extent.min_x), static_cast<float>(extent.max_x),
                           static_cast<float>(extent.min_y), static_cast<float>(extent.max_y),
                           static_cast<float>(resolution));
  auto& how = grid.insertionOptions;
  how.maxOccupancyUpdateCertainty = kHitCertainty;
  how.maxFreenessUpdateCertainty = kPassCertainty;
  how.considerInvalidRangesAsFreeSpace = false;
  how.horizontalTolerance = static_cast<float>(kTiltTolerance);
  for (const map::KeyFrame& frame : map.key_frames) {
    forEachScan(frame, [&](const mrpt::obs::CObservation2DRangeScan& scan) {
      // A beam as long as this clears its way and marks no wall; nothing came back at the sensor's own limit.
      how.maxDistanceInsertion = std::min(static_cast<float>(max_range), 0.9999f * scan.maxRange);
      grid.insertObservation(withoutOddRanges(scan), frame.map_from_base);
    });
  }
  return grid;
}

/// The part of `grid` that is known, and `margin` cells around it.
ScanGrid croppedGrid(const COccupancyGridMap2D& grid, int margin) {
  const int size_x = static_cast<int>(grid.getSizeX()), size_y = static_cast<int>(grid.getSizeY());
  const auto unknown = COccupancyGridMap2D::p2l(0.5f);
  int first_x = size_x, last_x = -1, first_y = size_y, last_y = -1;
  for (int y = 0; y < size_y; ++y) {
    const auto* row = grid.getRow(y);
    const auto known = [&](auto cell) { return cell != unknown; };
    const auto* first = std::find_if(row, row + size_x, known);
    if (first == row + size_x) continue;
    first_x = std::min(first_x, static_cast<int>(first - row));
    int last = size_x - 1;
    while (row[last] == unknown) --last;
    last_x = std::max(last_x, last);
    first_y = std::min(first_y, y);
    last_y = y;
  }
  ScanGrid result;
  if (last_x < 0) return result;
  result.resolution = grid.getResolution();
  result.columns = last_x - first_x + 1 + 2 * margin;
  result.rows = last_y - first_y + 1 + 2 * margin;
  result.min_x = grid.getXMin() + (first_x - margin) * result.resolution;
  result.min_y = grid.getYMin() + (first_y - margin) * result.resolution;
  result.cells.assign(static_cast<std::size_t>(result.columns) * result.rows, Cell::unknown);
  // MRPT's cells are of freeness.
  const auto occupied_below = COccupancyGridMap2D::p2l(1 - kOccupiedAbove);
  const auto free_above = COccupancyGridMap2D::p2l(1 - kFreeBelow);
  for (int y = first_y; y <= last_y; ++y) {
    const auto* row = grid.getRow(y) + first_x;
    Cell* out = &result.cells[static_cast<std::size_t>(y - first_y + margin) * result.columns + margin];
    for (int x = 0; x <= last_x - first_x; ++x) {
      out[x] = row[x] < occupied_below ? Cell::occupied : row[x] > free_above ? Cell::free : Cell::unknown;
    }
  }
  return result;
}

}  // namespace

std::optional<ScanGrid> buildScanGrid(const map::Map& map, const ScanGridOptions& options) {
  const Extent extent = extentOf(map, options.max_range);
  if (extent.empty()) return std::nullopt;
  double resolution = options.resolution;
  while (extent.cells(resolution) > options.max_cells) resolution *= 2;
  ScanGrid grid = croppedGrid(occupancyOf(map, extent, resolution, options.max_range),
                              static_cast<int>(std::ceil(options.margin / resolution)));
  if (grid.cells.empty()) return std::nullopt;
  grid.resolution = resolution;
  return grid;
}

}  // namespace omnimapper::plugins
