#include <omnimapper/eval/MapQuality.h>
#include <omnimapper/eval/Statistics.h>

#include <algorithm>
#include <cmath>

#include "CoveredSurface.h"

namespace omnimapper::eval {

namespace {

using surfaces::CellGrid;
using surfaces::Surface;
using surfaces::SurfaceClass;
using surfaces::SurfaceSet;

/// Whether a point of a true surface was seen; a surface without `seen` counts as seen as a whole.
bool isSeenAt(const CoveredSurface& truth, const Eigen::Vector3d& point) {
  if (!truth.surface->seen) return truth.contains(point);
  const auto cell = truth.surface->seen->cellAt(point);
  return cell && truth.surface->seen->isSet(*cell);
}

double seenArea(const CoveredSurface& truth) {
  return truth.surface->seen ? truth.surface->seen->area() : truth.cells.area();
}

class Judge {
 public:
  Judge(const SurfaceSet& map, const SurfaceSet& truth, const MapQualityOptions& options) : options_(options) {
    for (const auto& surface : truth.surfaces) truth_.emplace_back(surface, options.cell);
    for (const auto& surface : map.surfaces) map_.emplace_back(surface, options.cell);
    for (std::size_t i = 0; i < map_.size(); ++i) on_true_.push_back(trueCellsOf(map_[i]));
  }

  MapQuality judge() const {
    MapQuality quality;
    for (std::size_t i = 0; i < map_.size(); ++i) {
      const JudgedSurface judged = judgedAt(i);
      if (map_[i].surface->is_candidate) {
        quality.candidates.push_back(judged);
        continue;
      }
      if (!judged.is_spurious) ++quality.labels[map_[i].surface->is][*judged.true_class];
      quality.drawn.push_back(judged);
    }
    for (std::size_t i = 0; i < truth_.size(); ++i) addTrue(i, quality);
    addDoubles(quality);
    return quality;
  }

 private:
  // For each cell of a surface in the map, row by row: index of the true surface there; kNone if there is none or the
  // cell is not set.
  using TrueCells = std::vector<int>;
  static constexpr int kNone = -1;

  static std::size_t indexIn(const CellGrid& grid, CellGrid::Cell cell) {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(grid.columns()) +
           static_cast<std::size_t>(cell.column);
  }
  bool mayMeet(const CoveredSurface& a, const CoveredSurface& b) const { return eval::mayMeet(a, b, options_); }
  bool isOn(const CoveredSurface& truth, const Eigen::Vector3d& point) const {
    return std::abs(signedDistance(truth.surface->plane, point)) <= options_.max_distance && truth.contains(point);
  }
  // Of several true surfaces the nearest is taken, so that a door leaf in front of a wall is not the wall; surfaces
  // that were seen are preferred.
  TrueCells trueCellsOf(const CoveredSurface& mapped) const {
    std::vector<std::size_t> near;
    for (std::size_t t = 0; t < truth_.size(); ++t)
      if (mayMeet(mapped, truth_[t])) near.push_back(t);
    TrueCells cells(static_cast<std::size_t>(mapped.cells.rows()) * static_cast<std::size_t>(mapped.cells.columns()),
                    kNone);
    mapped.forEach([&](const Eigen::Vector3d& point, CellGrid::Cell cell) {
      int best = kNone;
      double best_distance = 1e300;
      for (const std::size_t t : near) {
        if (!isOn(truth_[t], point)) continue;
        const double unseen = isSeenAt(truth_[t], point) ? 0 : options_.max_distance;
        const double distance = unseen + std::abs(signedDistance(truth_[t].surface->plane, point));
        if (distance >= best_distance) continue;
        best_distance = distance;
        best = static_cast<int>(t);
      }
      cells[indexIn(mapped.cells, cell)] = best;
    });
    return cells;
  }

  JudgedSurface judgedAt(std::size_t i) const {
    JudgedSurface judged;
    judged.index = i;
    judged.area = map_[i].cells.area();
    std::map<std::size_t, std::size_t> on;
    std::map<SurfaceClass, std::size_t> classes;
    std::size_t all_on = 0;
    for (const int t : on_true_[i]) {
      if (t == kNone) continue;
      ++all_on;
      ++on[static_cast<std::size_t>(t)];
      ++classes[classAt(static_cast<std::size_t>(t))];
    }
    const std::size_t all = map_[i].cells.count();
    judged.share_on_true = all == 0 ? 0 : static_cast<double>(all_on) / static_cast<double>(all);
    judged.is_spurious = all == 0 || judged.share_on_true < options_.spurious_share;
    const auto most = [](const auto& a, const auto& b) { return a.second < b.second; };
    if (!on.empty()) judged.true_surface = std::max_element(on.begin(), on.end(), most)->first;
    if (!classes.empty()) judged.true_class = std::max_element(classes.begin(), classes.end(), most)->first;
    if (!judged.is_spurious) judged.overlap = overlapOf(i, on);
    return judged;
  }

  SurfaceClass classAt(std::size_t t) const {
    const SurfaceClass is = truth_[t].surface->is;
    return is == SurfaceClass::poster ? SurfaceClass::wall : is;
  }

  // Share of the seen part of true surface `t` that surface `i` of the map covers.
  double coverOf(std::size_t i, std::size_t t) const {
    std::size_t seen = 0, covered = 0;
    const auto count = [&](const Eigen::Vector3d& point, CellGrid::Cell) {
      ++seen;
      covered += coversAt(i, t, point);
    };
    forEachSeen(truth_[t], count);
    return seen == 0 ? 0 : static_cast<double>(covered) / static_cast<double>(seen);
  }
  template <class Use>
  static void forEachSeen(const CoveredSurface& truth, const Use& use) {
    forEachSetCell(truth.surface->seen ? *truth.surface->seen : truth.cells, use);
  }
  // A wall drawn across a closed door covers the wall, not the door leaf: the part there represents the nearest true
  // surface, which must be of the same class.
  bool coversAt(std::size_t i, std::size_t t, const Eigen::Vector3d& point_on_true) const {
    if (!mayMeet(map_[i], truth_[t]) ||
        std::abs(signedDistance(map_[i].surface->plane, point_on_true)) > options_.max_distance)
      return false;
    const auto cell = map_[i].cells.cellAt(point_on_true);
    if (!cell || !map_[i].cells.isSet(*cell)) return false;
    const int stands_for = on_true_[i][indexIn(map_[i].cells, *cell)];
    return stands_for != kNone && classAt(static_cast<std::size_t>(stands_for)) == classAt(t);
  }

  // `on`: number of cells on each true surface.
  double overlapOf(std::size_t i, const std::map<std::size_t, std::size_t>& on) const {
    constexpr double kMuch = 0.2;  // share of the map's surface
    std::vector<std::size_t> stands_for;
    std::vector<Eigen::Vector3d> corners = cornersOf(*map_[i].surface);
    for (const auto& [t, cells] : on) {
      const bool is_much = static_cast<double>(cells) >= kMuch * static_cast<double>(map_[i].cells.count());
      if (!is_much && coverOf(i, t) < options_.found_share) continue;
      stands_for.push_back(t);
      const auto more = cornersOf(*truth_[t].surface);
      corners.insert(corners.end(), more.begin(), more.end());
    }
    const CellGrid all = gridAround(*map_[i].surface, corners, options_.cell);
    std::size_t both = 0, either = 0;
    for (int row = 0; row < all.rows(); ++row) {
      for (int column = 0; column < all.columns(); ++column) {
        const Eigen::Vector3d point = all.middleOf({column, row});
        bool is_seen = false, is_poster = false;
        for (const std::size_t t : stands_for) is_seen = is_seen || isSeenAt(truth_[t], point);
        const bool is_mapped = map_[i].contains(point);
        if (is_mapped && !is_seen) is_poster = isPosterAt(i, point);
        if (is_poster) continue;  // a poster hides its wall
        both += is_mapped && is_seen;
        either += is_mapped || is_seen;
      }
    }
    return either == 0 ? 0 : static_cast<double>(both) / static_cast<double>(either);
  }
  bool isPosterAt(std::size_t i, const Eigen::Vector3d& point) const {
    return std::any_of(truth_.begin(), truth_.end(), [&](const CoveredSurface& truth) {
      return truth.surface->is == SurfaceClass::poster && mayMeet(map_[i], truth) && isOn(truth, point);
    });
  }

  void addTrue(std::size_t t, MapQuality& quality) const {
    const Surface& surface = *truth_[t].surface;
    if (surface.is_moved || surface.is == SurfaceClass::poster) return;
    const double area = areaOf(surface), seen = seenArea(truth_[t]);
    if (!(seen > 0)) return;
    std::vector<std::pair<double, std::size_t>> covers;
    std::vector<std::size_t> drawn;
    for (std::size_t i = 0; i < map_.size(); ++i) {
      if (map_[i].surface->is_candidate || !mayMeet(map_[i], truth_[t])) continue;
      drawn.push_back(i);
      covers.emplace_back(coverOf(i, t), i);
    }
    std::size_t all = 0, covered = 0;
    forEachSeen(truth_[t], [&](const Eigen::Vector3d& point, CellGrid::Cell) {
      ++all;
      covered += std::any_of(drawn.begin(), drawn.end(), [&](std::size_t i) { return coversAt(i, t, point); });
    });
    const double share = static_cast<double>(covered) / static_cast<double>(all);
    auto& of_class = quality.area[surface.is];
    of_class.seen += seen;
    of_class.covered += share * seen;
    if (area < options_.min_area || seen < options_.min_seen * area) return;
    SoughtSurface sought;
    sought.index = t;
    sought.covered = share;
    std::sort(covers.begin(), covers.end(), std::greater<>());
    for (const auto& [cover, i] : covers) {
      sought.is_found = sought.is_found || cover >= options_.found_share;
      if (cover >= options_.second_share) sought.by.push_back(i);
    }
    quality.sought.push_back(std::move(sought));
  }

  // Two surfaces are a double only where both represent the same true surface, or none.
  void addDoubles(MapQuality& quality) const {
    for (std::size_t k = 0; k < quality.drawn.size(); ++k) {
      for (std::size_t l = k + 1; l < quality.drawn.size(); ++l) {
        const std::size_t a = quality.drawn[k].index, b = quality.drawn[l].index;
        if (!mayMeet(map_[a], map_[b])) continue;
        const bool is_first = map_[a].cells.count() < map_[b].cells.count();
        const std::size_t small = is_first ? a : b, large = is_first ? b : a;
        if (sharedShare(small, large) >= options_.overlap_share) quality.doubles.emplace_back(a, b);
      }
    }
  }
  double sharedShare(std::size_t small, std::size_t large) const {
    const CoveredSurface &smaller = map_[small], &larger = map_[large];
    std::size_t shared = 0;
    smaller.forEach([&](const Eigen::Vector3d& point, CellGrid::Cell here) {
      if (std::abs(signedDistance(larger.surface->plane, point)) > options_.max_distance) return;
      const auto there = larger.cells.cellAt(point);
      shared += there && larger.cells.isSet(*there) &&
                on_true_[large][indexIn(larger.cells, *there)] == on_true_[small][indexIn(smaller.cells, here)];
    });
    const std::size_t all = smaller.cells.count();
    return all == 0 ? 0 : static_cast<double>(shared) / static_cast<double>(all);
  }

  MapQualityOptions options_;
  std::vector<CoveredSurface> truth_, map_;
  std::vector<TrueCells> on_true_;  // for each surface of the map
};

}  // namespace

MapQuality judgeMap(const SurfaceSet& map, const SurfaceSet& truth, const MapQualityOptions& options) {
  return Judge(map, truth, options).judge();
}

std::size_t MapQuality::found() const {
  return static_cast<std::size_t>(
      std::count_if(sought.begin(), sought.end(), [](const auto& s) { return s.is_found; }));
}

std::size_t MapQuality::foundOnce() const {
  return static_cast<std::size_t>(
      std::count_if(sought.begin(), sought.end(), [](const auto& s) { return s.isOnce(); }));
}

std::size_t MapQuality::spurious() const {
  return static_cast<std::size_t>(
      std::count_if(drawn.begin(), drawn.end(), [](const auto& d) { return d.is_spurious; }));
}

std::size_t MapQuality::trueCandidates() const {
  return static_cast<std::size_t>(
      std::count_if(candidates.begin(), candidates.end(), [](const auto& c) { return !c.is_spurious; }));
}

std::size_t MapQuality::rightLabels() const {
  std::size_t right = 0;
  for (const auto& said : labels) right += rightOf(said.first).first;
  return right;
}

std::pair<std::size_t, std::size_t> MapQuality::rightOf(SurfaceClass said) const {
  std::size_t right = 0, all = 0;
  const auto found = labels.find(said);
  if (found == labels.end()) return {0, 0};
  for (const auto& [true_class, count] : found->second) {
    all += count;
    if (true_class == said) right += count;
  }
  return {right, all};
}

double MapQuality::medianOverlap() const {
  std::vector<double> overlaps;
  for (const auto& one : drawn)
    if (one.overlap) overlaps.push_back(*one.overlap);
  return statisticsOf(overlaps).median;
}

std::vector<surfaces::Example> examplesOf(const MapQuality& quality, const SurfaceSet& map) {
  constexpr double kMuch = 0.6;  // smallest share of a surface on true ones that makes it an example of its class
  const auto facts = surfaces::factsOf(map.surfaces, 0);
  std::vector<surfaces::Example> examples;
  for (const auto* list : {&quality.drawn, &quality.candidates}) {
    for (const auto& judged : *list)
      if (judged.true_class && judged.share_on_true >= kMuch)
        examples.push_back({*judged.true_class, facts[judged.index]});
  }
  return examples;
}

}  // namespace omnimapper::eval
