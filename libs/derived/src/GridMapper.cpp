#include <omnimapper/derived/GridMapper.h>
#include <omnimapper/derived/forEachScan.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/grid/ScanBeams.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace omnimapper::derived {

namespace {

constexpr double kStepsPerCell = 4;
constexpr double kTiltTolerance = 10 * geometry::kPi / 180;
constexpr double kMostSteps = 1e15;  // beyond that a double cannot resolve cells

Cell cellOf(std::int32_t log_odds) {
  return log_odds > grid::kOccupiedAbove ? Cell::occupied : log_odds < grid::kFreeBelow ? Cell::free : Cell::unknown;
}

}  // namespace

void GridMapper::Extent::add(const mrpt::math::TPoint3D& place, double around) {
  add({place.x - around, place.x + around, place.y - around, place.y + around});
}

void GridMapper::Extent::add(const Extent& other) {
  min_x = std::min(min_x, other.min_x), max_x = std::max(max_x, other.max_x);
  min_y = std::min(min_y, other.min_y), max_y = std::max(max_y, other.max_y);
}

double GridMapper::Extent::cells(double resolution, double margin) const {
  // Number of cells along a side: its length, plus a cell at each end that may be touched only partly.
  const auto along = [&](double length) { return (length + 2 * margin) / resolution + 2; };
  return min_x > max_x ? 0 : along(max_x - min_x) * along(max_y - min_y);
}

GridMapper::GridMapper(const ScanGridOptions& options)
    : options_(options),
      step_(options.resolution / kStepsPerCell),
      resolution_(options.resolution),
      tracer_(options.max_range) {}

double GridMapper::reachOf(const mrpt::obs::CObservation2DRangeScan& scan) const {
  const grid::BeamEnds ends(scan, {}, grid::BeamEnds::Pose::of_sensor);
  float reach = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends.range(i) > reach && ends.clears(i)) reach = ends.range(i);
  }
  return std::min({static_cast<double>(reach), options_.max_range, static_cast<double>(scan.maxRange)});
}

std::vector<GridMapper::Placement> GridMapper::placementsOf(const map::KeyFrame& frame,
                                                            const std::vector<Placement>& before) const {
  const double least_upright = std::cos(kTiltTolerance);
  std::vector<Placement> placements;
  forEachScan(frame, [&](const auto& scan) {
    const auto map_from_sensor = frame.map_from_base + scan->sensorPose;
    if (!(std::abs(map_from_sensor.getRotationMatrix()(2, 2)) >= least_upright)) return;
    const auto known = std::find_if(before.begin(), before.end(), [&](const auto& p) { return p.scan == scan; });
    Placement placement{scan, known != before.end() ? known->reach : reachOf(*scan), {}};
    if (placement.reach <= 0) return;
    const double turn = step_ / placement.reach;
    const std::array<double, 5> steps{map_from_sensor.x() / step_, map_from_sensor.y() / step_,
                                      map_from_sensor.yaw() / turn, map_from_sensor.pitch() / turn,
                                      map_from_sensor.roll() / turn};
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (!(std::abs(steps[i]) < kMostSteps)) return;
      placement.at[i] = std::llround(steps[i]);
    }
    placements.push_back(std::move(placement));
  });
  return placements;
}

mrpt::poses::CPose3D GridMapper::poseOf(const Placement& placement) const {
  const auto at = [&](std::size_t i, double step) { return static_cast<double>(placement.at[i]) * step; };
  const double turn = step_ / placement.reach;
  return {at(0, step_), at(1, step_), 0, at(2, turn), at(3, turn), at(4, turn)};
}

GridMapper::Extent GridMapper::extentOf(const std::vector<Placement>& placements) const {
  Extent extent;
  for (const Placement& placement : placements) {
    const grid::BeamEnds ends(*placement.scan, poseOf(placement), grid::BeamEnds::Pose::of_sensor);
    extent.add(ends.origin(), 0);
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (ends.clears(i)) extent.add(ends.at(i, placement.reach), 0);
    }
  }
  return extent;
}

double GridMapper::fittingResolution() {
  Extent most;
  for (const auto& [id, entry] : entries_) {
    for (const Placement& placement : entry.placements) most.add(poseOf(placement).translation(), placement.reach);
  }
  if (most.cells(options_.resolution, options_.margin) <= options_.max_cells) return options_.resolution;
  Extent extent;
  for (auto& [id, entry] : entries_) {
    if (!entry.extent) entry.extent = extentOf(entry.placements);
    extent.add(*entry.extent);
  }
  double resolution = options_.resolution;
  while (extent.cells(resolution, options_.margin) > options_.max_cells) resolution *= 2;
  return resolution;
}

void GridMapper::enter(const std::vector<Placement>& placements) {
  for (const Placement& placement : placements) {
    grid_.add(tracer_.trace(*placement.scan, poseOf(placement), resolution_));
    ++traced_;
  }
}

void GridMapper::takeOut(const std::vector<Placement>& placements) {
  for (const Placement& placement : placements) {
    grid_.takeOut(tracer_.trace(*placement.scan, poseOf(placement), resolution_));
    ++traced_;
  }
}

bool GridMapper::update(const map::Map& map) {
  ++updates_;
  std::vector<std::pair<Entry*, std::vector<Placement>>> moved;  // with the former placements
  for (const map::KeyFrame& frame : map.key_frames) {
    Entry& entry = entries_[frame.id];
    entry.seen = updates_;
    auto placements = placementsOf(frame, entry.placements);
    if (placements == entry.placements) continue;
    std::swap(entry.placements, placements);
    entry.extent.reset();
    moved.emplace_back(&entry, std::move(placements));
  }
  std::vector<std::vector<Placement>> gone;
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    if (entry->second.seen == updates_) {
      ++entry;
    } else {
      gone.push_back(std::move(entry->second.placements));
      entry = entries_.erase(entry);
    }
  }
  if (moved.empty() && gone.empty()) return false;
  const double resolution = fittingResolution();
  if (resolution != resolution_) {
    resolution_ = resolution;
    grid_.clear();
    for (const auto& [id, entry] : entries_) enter(entry.placements);
    return true;
  }
  for (const auto& placements : gone) takeOut(placements);
  for (const auto& [entry, before] : moved) takeOut(before), enter(entry->placements);
  return true;
}

std::optional<ScanGrid> GridMapper::scanGrid() const {
  const grid::CellBox box = grid_.bounds();
  if (box.max_x < box.min_x) return std::nullopt;
  const auto margin = static_cast<std::int64_t>(std::ceil(options_.margin / resolution_));
  const std::int64_t left = box.min_x - margin, low = box.min_y - margin;
  ScanGrid result;
  result.resolution = resolution_;
  result.columns = static_cast<int>(box.max_x - left + 1 + margin);
  result.rows = static_cast<int>(box.max_y - low + 1 + margin);
  result.min_x = static_cast<double>(left) * resolution_;
  result.min_y = static_cast<double>(low) * resolution_;
  result.cells.assign(static_cast<std::size_t>(result.columns) * result.rows, Cell::unknown);
  constexpr int kSide = grid::OccupancyGrid::kTileSide;
  for (const auto& [index, tile] : grid_.tiles()) {
    // Position of the tile in the result; at the border only a part of the tile lies within.
    const std::int64_t x = index.x * kSide - left, y = index.y * kSide - low;
    const auto begin_x = static_cast<int>(std::max<std::int64_t>(0, -x));
    const auto end_x = static_cast<int>(std::min<std::int64_t>(kSide, result.columns - x));
    const auto begin_y = static_cast<int>(std::max<std::int64_t>(0, -y));
    const auto end_y = static_cast<int>(std::min<std::int64_t>(kSide, result.rows - y));
    for (auto row = begin_y; row < end_y; ++row) {
      Cell* out = result.cells.data() + (y + row) * result.columns + x;
      for (auto column = begin_x; column < end_x; ++column) out[column] = cellOf(tile->at(column, row));
    }
  }
  return result;
}

}  // namespace omnimapper::derived
