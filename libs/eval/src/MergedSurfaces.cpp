#include "MergedSurfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace omnimapper::eval {

namespace {

using surfaces::CellGrid;

/// A surface that grows by adding planes of views that lie on it.
class GrowingSurface {
 public:
  GrowingSurface(const PlaneCells& first, const MapQualityOptions& options)
      : normal_cosine_(std::cos(options.max_turn)), options_(options), box_(first.covered.box) {
    grown_.surface.name = first.covered.surface->name;
    grown_.surface.plane = first.covered.surface->plane;
    grown_.surface.seen.emplace(first.covered.cells);
    grown_.seen_twice = emptyLike(first.covered.cells);
    grown_.planes.emplace_back(first.view, first.plane);
    count_ = first.covered.cells.count();
  }

  bool takes(const PlaneCells& more) {
    const CoveredSurface& covered = more.covered;
    if (plane().normal.dot(covered.surface->plane.normal) < normal_cosine_ ||
        box_.exteriorDistance(covered.box) > options_.max_distance)
      return false;
    std::size_t shared = 0;
    covered.forEach([&](const Eigen::Vector3d& point, CellGrid::Cell) { shared += isOnPlane(point) && has(point); });
    const auto smaller = static_cast<double>(std::min(count_, covered.cells.count()));
    if (static_cast<double>(shared) < options_.overlap_share * smaller) return false;
    add(more);
    return true;
  }
  MergedSurface take() { return std::move(grown_); }

 private:
  const geometry::Plane3& plane() const { return grown_.surface.plane; }
  static CellGrid emptyLike(const CellGrid& grid) {
    return {grid.origin(), grid.u(), grid.v(), grid.cell(), grid.columns(), grid.rows()};
  }
  bool isOnPlane(const Eigen::Vector3d& point) const {
    return std::abs(signedDistance(plane(), point)) <= options_.max_distance;
  }
  bool has(const Eigen::Vector3d& point) const {
    const auto cell = grown_.surface.seen->cellAt(point);
    return cell && grown_.surface.seen->isSet(*cell);
  }
  void add(const PlaneCells& more) {
    std::vector<Eigen::Vector3d> points;
    more.covered.forEach([&](const Eigen::Vector3d& point, CellGrid::Cell) {
      if (isOnPlane(point)) points.push_back(point - signedDistance(plane(), point) * plane().normal);
    });
    CellGrid& seen = *grown_.surface.seen;
    seen = seen.grownTo(plane(), points, options_.cell);
    CellGrid twice = emptyLike(seen);
    forEachSetCell(grown_.seen_twice, [&](const Eigen::Vector3d& point, CellGrid::Cell) {
      if (const auto cell = twice.cellAt(point)) twice.set(*cell);
    });
    for (const auto& point : points) {
      const auto cell = seen.cellAt(point);
      if (!cell) continue;
      if (seen.isSet(*cell)) twice.set(*cell);
    }
    for (const auto& point : points)
      if (const auto cell = seen.cellAt(point)) seen.set(*cell);
    grown_.seen_twice = std::move(twice);
    grown_.planes.emplace_back(more.view, more.plane);
    box_.extend(more.covered.box);
    count_ = seen.count();
  }

  double normal_cosine_;
  const MapQualityOptions& options_;
  MergedSurface grown_;
  Eigen::AlignedBox3d box_;
  std::size_t count_ = 0;  // cells
};

}  // namespace

double sharedShare(const CoveredSurface& smaller, const CoveredSurface& larger, const MapQualityOptions& options) {
  std::size_t shared = 0;
  smaller.forEach([&](const Eigen::Vector3d& point, CellGrid::Cell) {
    shared += std::abs(signedDistance(larger.surface->plane, point)) <= options.max_distance && larger.contains(point);
  });
  const std::size_t all = smaller.cells.count();
  return all == 0 ? 0 : static_cast<double>(shared) / static_cast<double>(all);
}

bool areSame(const CoveredSurface& a, const CoveredSurface& b, const MapQualityOptions& options) {
  if (!mayMeet(a, b, options)) return false;
  const bool is_first = a.cells.count() < b.cells.count();
  return sharedShare(is_first ? a : b, is_first ? b : a, options) >= options.overlap_share;
}

std::vector<MergedSurface> unitePlanes(const std::vector<PlaneCells>& planes, const MapQualityOptions& options) {
  std::vector<std::size_t> left(planes.size());
  std::iota(left.begin(), left.end(), 0U);
  std::stable_sort(left.begin(), left.end(), [&](std::size_t a, std::size_t b) {
    return planes[a].covered.cells.count() > planes[b].covered.cells.count();
  });
  std::vector<MergedSurface> united;
  while (!left.empty()) {
    GrowingSurface surface(planes[left.front()], options);
    left.erase(left.begin());
    for (bool has_grown = true; has_grown;) {
      const auto end =
          std::remove_if(left.begin(), left.end(), [&](std::size_t i) { return surface.takes(planes[i]); });
      has_grown = end != left.end();
      left.erase(end, left.end());
    }
    united.push_back(surface.take());
  }
  std::stable_sort(united.begin(), united.end(),
                   [](const auto& a, const auto& b) { return a.surface.seen->count() > b.surface.seen->count(); });
  return united;
}

}  // namespace omnimapper::eval
