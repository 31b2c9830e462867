#pragma once

#include <omnimapper/grid/OccupancyGrid.h>
#include <omnimapper/grid/ScanTracer.h>
#include <omnimapper/map/Map.h>

#include <array>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

#include "grid/ScanGrid.h"

namespace omnimapper::exports {

/// Keeps the occupancy grid of a map that changes: key frames that moved are taken out and entered again, the others
/// stay. Poses are rounded to a quarter of a cell, at the sensor and at the far end of the scan; only what then differs
/// has moved, so the grid is the same, cell for cell, as one built at once of the same map.
class GridMapper {
 public:
  explicit GridMapper(const ScanGridOptions& options);

  /// Follows the map. True if the grid changed.
  bool update(const map::Map& map);
  /// None while no scan has a valid beam.
  std::optional<ScanGrid> scanGrid() const;
  /// Scans entered or taken out since the beginning.
  std::size_t traced() const { return traced_; }

 private:
  struct Extent {
    double min_x = 1e300, max_x = -1e300, min_y = 1e300, max_y = -1e300;
    void add(const Extent& other);
    void add(const mrpt::math::TPoint3D& place, double around);
    double cells(double resolution, double margin) const;
  };
  /// A scan and where it is, rounded.
  struct Placement {
    mrpt::obs::CObservation2DRangeScan::ConstPtr scan;
    double reach = 0;                  // [m] longest beam
    std::array<std::int64_t, 5> at{};  // x, y, yaw, pitch, roll in steps
    bool operator==(const Placement& other) const { return scan == other.scan && at == other.at; }
  };
  struct Entry {
    std::vector<Placement> placements;
    std::optional<Extent> extent;  // found when it is asked for
    std::size_t seen = 0;          // the update that met its key frame last
  };

  double reachOf(const mrpt::obs::CObservation2DRangeScan& scan) const;
  std::vector<Placement> placementsOf(const map::KeyFrame& frame, const std::vector<Placement>& before) const;
  mrpt::poses::CPose3D poseOf(const Placement& placement) const;
  Extent extentOf(const std::vector<Placement>& placements) const;
  /// The finest that gives at most max_cells.
  double fittingResolution();
  void enter(const std::vector<Placement>& placements);
  void takeOut(const std::vector<Placement>& placements);

  ScanGridOptions options_;
  double step_;  // [m] to which positions are rounded
  double resolution_;
  grid::ScanTracer tracer_;
  grid::OccupancyGrid grid_;
  std::unordered_map<base::KeyFrameId, Entry> entries_;
  std::size_t updates_ = 0, traced_ = 0;
};

}  // namespace omnimapper::exports
