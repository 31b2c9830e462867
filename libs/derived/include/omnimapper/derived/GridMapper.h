#pragma once

#include <omnimapper/derived/ScanGrid.h>
#include <omnimapper/grid/OccupancyGrid.h>
#include <omnimapper/grid/ScanTracer.h>
#include <omnimapper/map/Map.h>

#include <array>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

namespace omnimapper::derived {

/// Maintains the occupancy grid of a changing map: the scans of key frames that moved are removed and entered again,
/// the others stay. Poses are rounded to a quarter of a cell, at the sensor and at the far end of the scan, and only a
/// change of the rounded pose counts as motion. The grid is therefore the same, cell for cell, as one built at once
/// from the same map.
class GridMapper {
 public:
  explicit GridMapper(const ScanGridOptions& options);

  /// Updates the grid to the map. Returns true if the grid changed.
  bool update(const map::Map& map);
  /// The grid; none if no scan has a valid beam.
  std::optional<ScanGrid> scanGrid() const;
  /// Number of scans that were entered or removed so far.
  std::size_t traced() const { return traced_; }

 private:
  struct Extent {
    double min_x = 1e300, max_x = -1e300, min_y = 1e300, max_y = -1e300;
    void add(const Extent& other);
    void add(const mrpt::math::TPoint3D& place, double around);
    double cells(double resolution, double margin) const;
  };
  /// A scan and its rounded pose.
  struct Placement {
    mrpt::obs::CObservation2DRangeScan::ConstPtr scan;
    double reach = 0;                  // [m] length of the longest beam
    std::array<std::int64_t, 5> at{};  // x, y, yaw, pitch, roll in steps
    bool operator==(const Placement& other) const { return scan == other.scan && at == other.at; }
  };
  struct Entry {
    std::vector<Placement> placements;
    std::optional<Extent> extent;  // computed on demand
    std::size_t seen = 0;          // number of the last update in which the key frame existed
  };

  double reachOf(const mrpt::obs::CObservation2DRangeScan& scan) const;
  std::vector<Placement> placementsOf(const map::KeyFrame& frame, const std::vector<Placement>& before) const;
  mrpt::poses::CPose3D poseOf(const Placement& placement) const;
  Extent extentOf(const std::vector<Placement>& placements) const;
  /// The finest resolution that gives at most max_cells.
  double fittingResolution();
  void enter(const std::vector<Placement>& placements);
  void takeOut(const std::vector<Placement>& placements);

  ScanGridOptions options_;
  double step_;  // [m] positions are rounded to multiples of it
  double resolution_;
  grid::ScanTracer tracer_;
  grid::OccupancyGrid grid_;
  std::unordered_map<base::KeyFrameId, Entry> entries_;
  std::size_t updates_ = 0, traced_ = 0;
};

}  // namespace omnimapper::derived
