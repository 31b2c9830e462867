#include <omnimapper/eval/ViewAgreement.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "MergedSurfaces.h"

namespace omnimapper::eval {

namespace {

using surfaces::CellGrid;

// Area of the cells that are set and covered [m^2].
double areaWhere(const CellGrid& cells, const std::function<bool(const Eigen::Vector3d&)>& is_covered) {
  std::size_t count = 0;
  forEachSetCell(cells, [&](const Eigen::Vector3d& middle, CellGrid::Cell) { count += is_covered(middle); });
  return cells.areaOfCell() * static_cast<double>(count);
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

class ViewJudge {
 public:
  ViewJudge(const surfaces::SurfaceSet& map, const std::vector<View>& views, const ViewAgreementOptions& options)
      : options_(options), views_(views) {
    for (std::size_t i = 0; i < map.surfaces.size(); ++i) {
      if (map.surfaces[i].is_candidate) continue;
      drawn_.emplace_back(map.surfaces[i], options.same.cell);
      index_.push_back(i);
    }
    for (std::size_t v = 0; v < views.size(); ++v) {
      for (std::size_t p = 0; p < views[v].planes.size(); ++p) {
        PlaneCells plane{v, p, CoveredSurface::bySeen(views[v].planes[p].surface, options.same.cell)};
        if (plane.covered.cells.area() >= options.min_plane) planes_.push_back(std::move(plane));
      }
    }
  }

  ViewAgreement judge() const {
    ViewAgreement agreement;
    agreement.views = views_.size();
    agreement.planes = planes_.size();
    agreement.drawn = drawn_.size();
    agreement.seen = unitePlanes(planes_, options_.same);
    addSplit(agreement);
    addDoubles(agreement);
    for (auto& seen : agreement.seen) addArea(seen, agreement);
    for (std::size_t s = 0; s < agreement.seen.size(); ++s) {
      const surfaces::Surface& surface = agreement.seen[s].surface;
      const bool is_level = surface.plane.normal.z() >= std::cos(options_.same.max_turn);
      if (is_level && surface.seen->area() >= options_.same.min_area)
        agreement.levels.push_back(piecesOf(s, agreement.seen[s]));
    }
    addDistances(agreement);
    return agreement;
  }

 private:
  bool isOn(const CoveredSurface& drawn, const Eigen::Vector3d& point) const {
    return std::abs(signedDistance(drawn.surface->plane, point)) <= options_.same.max_distance && drawn.contains(point);
  }
  // Indices of the drawn surfaces that may cover a part of a surface with this plane and box.
  std::vector<std::size_t> near(const geometry::Plane3& plane, const Eigen::AlignedBox3d& box) const {
    std::vector<std::size_t> near;
    for (std::size_t d = 0; d < drawn_.size(); ++d) {
      if (drawn_[d].surface->plane.normal.dot(plane.normal) >= std::cos(options_.same.max_turn) &&
          drawn_[d].box.exteriorDistance(box) <= options_.same.max_distance)
        near.push_back(d);
    }
    return near;
  }

  void addSplit(ViewAgreement& agreement) const {
    // For each pair of drawn surfaces, the planes of views that lie on both.
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> on_both;
    for (std::size_t p = 0; p < planes_.size(); ++p) {
      std::vector<std::size_t> on;
      for (const std::size_t d : near(planes_[p].covered.surface->plane, planes_[p].covered.box)) {
        if (drawn_[d].cells.area() >= options_.same.min_area &&
            sharedShare(planes_[p].covered, drawn_[d], options_.same) >= options_.same.overlap_share)
          on.push_back(d);
      }
      for (std::size_t i = 0; i < on.size(); ++i)
        for (std::size_t j = i + 1; j < on.size(); ++j) on_both[{on[i], on[j]}].push_back(p);
    }
    for (const auto& [pair, planes] : on_both) {
      SplitSurface split{{index_[pair.first], index_[pair.second]}, nameOf(planes.front()), ""};
      if (const auto confirmed = twoThatAgree(planes)) {
        split.view = nameOf(confirmed->first);
        split.other_view = nameOf(confirmed->second);
      }
      (split.other_view.empty() ? agreement.split_of_one : agreement.split).push_back(split);
    }
  }
  std::string nameOf(std::size_t p) const { return views_[planes_[p].view].name; }
  // Two planes of different views that show the same surface; none if there are none.
  std::optional<std::pair<std::size_t, std::size_t>> twoThatAgree(const std::vector<std::size_t>& planes) const {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      for (std::size_t j = i + 1; j < planes.size(); ++j) {
        const PlaneCells &a = planes_[planes[i]], &b = planes_[planes[j]];
        if (a.view != b.view && areSame(a.covered, b.covered, options_.same)) return std::pair(planes[i], planes[j]);
      }
    }
    return std::nullopt;
  }

  void addDoubles(ViewAgreement& agreement) const {
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      for (std::size_t j = i + 1; j < drawn_.size(); ++j)
        if (areSame(drawn_[i], drawn_[j], options_.same)) agreement.doubles.emplace_back(index_[i], index_[j]);
    }
  }

  Eigen::AlignedBox3d boxOf(const CellGrid& cells) const {
    Eigen::AlignedBox3d box;
    forEachSetCell(cells, [&](const Eigen::Vector3d& middle, CellGrid::Cell) { box.extend(middle); });
    return box;
  }
  void addArea(MergedSurface& seen, ViewAgreement& agreement) const {
    const CellGrid& cells = *seen.surface.seen;
    const auto on = near(seen.surface.plane, boxOf(cells));
    const auto is_covered = [&](const Eigen::Vector3d& point) {
      return std::any_of(on.begin(), on.end(), [&](std::size_t d) { return isOn(drawn_[d], point); });
    };
    agreement.area.seen += cells.area();
    agreement.area.covered += areaWhere(cells, is_covered);
    agreement.area_twice.seen += seen.seen_twice.area();
    agreement.area_twice.covered += areaWhere(seen.seen_twice, is_covered);
    const CellGrid& twice = seen.seen_twice;
    seen.missing = {twice.origin(), twice.u(), twice.v(), twice.cell(), twice.columns(), twice.rows()};
    forEachSetCell(twice, [&](const Eigen::Vector3d& middle, CellGrid::Cell cell) {
      if (!is_covered(middle)) seen.missing.set(cell);
    });
  }

  LevelPieces piecesOf(std::size_t merged_surface, const MergedSurface& level) const {
    LevelPieces pieces;
    pieces.merged_surface = merged_surface;
    const CellGrid& cells = *level.surface.seen;
    pieces.area = cells.area();
    double heights = 0;
    forEachSetCell(cells, [&](const Eigen::Vector3d& middle, CellGrid::Cell) { heights += middle.z(); });
    pieces.height = heights / static_cast<double>(cells.count());
    std::vector<std::pair<double, std::size_t>> have;
    for (const std::size_t d : near(level.surface.plane, boxOf(cells))) {
      const double area = areaWhere(cells, [&](const Eigen::Vector3d& point) { return isOn(drawn_[d], point); });
      if (area >= options_.piece_share * pieces.area) have.emplace_back(area, index_[d]);
    }
    std::sort(have.begin(), have.end(), std::greater<>());
    for (const auto& one : have) pieces.of_map.push_back(one.second);
    std::map<std::size_t, std::size_t> planes_of_view;
    for (const auto& plane : level.planes) ++planes_of_view[plane.first];
    for (const auto& one : planes_of_view) pieces.in_views.push_back(one.second);
    std::sort(pieces.in_views.begin(), pieces.in_views.end(), std::greater<>());
    return pieces;
  }

  void addDistances(ViewAgreement& agreement) const {
    std::vector<double> distances;
    for (const PlaneCells& plane : planes_) {
      const ViewPlane& seen = views_[plane.view].planes[plane.plane];
      const auto on = near(seen.surface.plane, plane.covered.box);
      agreement.points += seen.points.size();
      for (const auto& point : seen.points) {
        double least = 1e300;
        for (const std::size_t d : on)
          if (isOn(drawn_[d], point))
            least = std::min(least, std::abs(signedDistance(drawn_[d].surface->plane, point)));
        if (least <= options_.same.max_distance) distances.push_back(least);
      }
    }
    agreement.distance = statisticsOf(distances);
    agreement.distance_95 = quantile(std::move(distances), 0.95);
  }

  ViewAgreementOptions options_;
  const std::vector<View>& views_;
  std::vector<CoveredSurface> drawn_;
  std::vector<std::size_t> index_;  // of each drawn surface in the map's set
  std::vector<PlaneCells> planes_;
};

}  // namespace

ViewAgreement judgeByViews(const surfaces::SurfaceSet& map, const std::vector<View>& views,
                           const ViewAgreementOptions& options) {
  return ViewJudge(map, views, options).judge();
}

}  // namespace omnimapper::eval
