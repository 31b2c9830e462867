#include <omnimapper/base/Error.h>
#include <omnimapper/matching/CorrelativeSearch.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kTopLevel = 6;  // largest level of a block of poses: 64 steps a side
constexpr double kMostSteps = 1 << 30;

// Poses of one area: 2^level steps a side in x, y and yaw, counted from the window's corner.
struct Block {
  int x, y, yaw;
  int bound;  // upper bound of its poses' scores, in [0, 255 * points]
  int next;   // next block with the same bound in the queue
  int area : 24;
  int level : 8;
};

// Priority queue of blocks, the highest bound first. Among equals the last one added comes first, so that the search
// goes deep before it goes wide.
class Queue {
 public:
  explicit Queue(int highest) : heads_(highest + 1, -1), current_(highest) {}

  // The bound must be at most that of the last block popped.
  void push(const Block& block) {
    int slot = free_;
    if (slot >= 0) {
      free_ = blocks_[slot].next;
      blocks_[slot] = block;
    } else {
      slot = static_cast<int>(blocks_.size());
      blocks_.push_back(block);
    }
    blocks_[slot].next = heads_[block.bound];
    heads_[block.bound] = slot;
  }

  bool pop(int lowest, Block& block) {
    while (current_ >= lowest && heads_[current_] < 0) --current_;
    if (current_ < lowest) return false;
    const int slot = heads_[current_];
    block = blocks_[slot];
    heads_[current_] = block.next;
    blocks_[slot].next = free_;
    free_ = slot;
    return true;
  }

 private:
  std::vector<int> heads_;
  std::vector<Block> blocks_;
  int current_, free_ = -1;
};

// A point of the scan rotated into the map, for the first block of a row of blocks: the cell where its sweep begins,
// and the level whose squares cover it.
struct Sweep {
  int x, y, level;
};

// The blocks of one level that share their headings.
struct Row {
  std::vector<Sweep> sweeps;
  int unbounded = -1;  // number of points whose sweep no square covers; -1 if not computed yet
};

// Steps of a lattice along one axis, counted from the window's centre.
struct Steps {
  int first = 0, count = 1;
};

void requireWindow(const SearchWindow& window) {
  const auto& [x, y, phi] = window.centre;
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(phi)) {
    throw base::Error(base::ExitCode::out_of_range, "The search window's centre is not finite: it must be a pose");
  }
  for (const double half : {window.half_x, window.half_y, window.half_yaw}) {
    if (half >= 0 && std::isfinite(half)) continue;
    throw base::Error(base::ExitCode::out_of_range, "Half a side of the search window is " + std::to_string(half) +
                                                        ", but must be finite and not negative");
  }
}

// The steps within `half` of 0 and within [low, high].
Steps stepsWithin(double half, double low, double high, double step) {
  const double most = std::floor(half / step + 1e-9), first = std::max(-most, std::floor(low / step)),
               last = std::min(most, std::ceil(high / step));
  if (!(first <= last) || std::abs(first) > kMostSteps || std::abs(last) > kMostSteps) return {0, 0};
  return {static_cast<int>(first), static_cast<int>(last - first) + 1};
}

// The lattice of poses of one map and its window.
class Lattice {
 public:
  Lattice(const SearchArea& area, const std::vector<Eigen::Vector2f>& points)
      : map_(*area.map), points_(points), centre_(area.window.centre), yaw_step_(yawStep(points, map_.cell())) {
    const SearchWindow& window = area.window;
    requireWindow(window);
    if (map_.empty() || points.empty()) return;
    // A scan farther away from the map than its longest range cannot touch it.
    double reach = 0;
    for (const auto& point : points) reach = std::max(reach, static_cast<double>(point.norm()));
    const Eigen::Vector2d low = map_.origin().array() - reach,
                          high = map_.high() * 2 - map_.origin() + (map_.low() - low);
    x_ = stepsWithin(window.half_x, low.x() - centre_.x, high.x() - centre_.x, map_.cell());
    y_ = stepsWithin(window.half_y, low.y() - centre_.y, high.y() - centre_.y, map_.cell());
    if (window.half_yaw >= kPi) {
      yaw_.count = static_cast<int>(std::ceil(2 * kPi / yaw_step_));
      yaw_step_ = 2 * kPi / yaw_.count;
      yaw_.first = -(yaw_.count / 2);
    } else {
      yaw_ = stepsWithin(window.half_yaw, -kPi, kPi, yaw_step_);
    }
    const int longest = std::max({x_.count, y_.count, yaw_.count});
    while (top_ < kTopLevel && (1 << top_) < longest) ++top_;
    rows_.resize(top_ + 1);
    for (int level = 0; level <= top_; ++level) rows_[level].resize(((yaw_.count - 1) >> level) + 1);
  }

  int top() const { return top_; }
  bool holds(int x, int y, int yaw) const { return x < x_.count && y < y_.count && yaw < yaw_.count; }

  TPose2D pose(int x, int y, int yaw) const { return poseBetween(x, y, yaw); }

  // Sum of the points' bounds over a block; 0 as soon as it is known to be below `lowest`.
  int bound(const Block& block, int lowest) {
    const Row& row = rowOf(block.level, block.yaw >> block.level);
    int sum = 255 * row.unbounded, rest = 255 * static_cast<int>(row.sweeps.size());
    const Sweep *sweep = row.sweeps.data(), *const end = sweep + row.sweeps.size();
    while (sweep != end) {
      const Sweep* const part = std::min(sweep + 16, end);
      rest -= 255 * static_cast<int>(part - sweep);
      for (; sweep != part; ++sweep) sum += map_.bound(sweep->level, sweep->x + block.x, sweep->y + block.y);
      if (sum + rest < lowest) return 0;
    }
    return sum;
  }

  // Whether no pose of the block is distinct from `other`.
  bool liesWithin(const Block& block, const TPose2D& other, const SearchOptions& options) const {
    const double last = (1 << block.level) - 1, half = 0.5 * last;
    const TPose2D middle = poseBetween(block.x + half, block.y + half, block.yaw + half);
    const double dx = std::abs(middle.x - other.x) + half * map_.cell(),
                 dy = std::abs(middle.y - other.y) + half * map_.cell(),
                 turn = std::abs(std::remainder(middle.phi - other.phi, 2 * kPi)) + half * yaw_step_;
    return std::hypot(dx, dy) <= options.min_distance && turn <= options.min_angle;
  }

 private:
  TPose2D poseBetween(double x, double y, double yaw) const {
    TPose2D pose{centre_.x + (x_.first + x) * map_.cell(), centre_.y + (y_.first + y) * map_.cell(),
                 centre_.phi + (yaw_.first + yaw) * yaw_step_};
    pose.normalizePhi();
    return pose;
  }

  const Row& rowOf(int level, int yaw_block) {
    Row& row = rows_[level][yaw_block];
    if (row.unbounded >= 0) return row;
    row.unbounded = 0;
    row.sweeps.reserve(points_.size());
    const int side = 1 << level;
    const double half_turn = 0.5 * (side - 1) * yaw_step_,
                 middle = centre_.phi + (yaw_.first + (yaw_block << level)) * yaw_step_ + half_turn;
    const double c = std::cos(middle), s = std::sin(middle), to_cells = 1 / map_.cell();
    const double sine = half_turn > 0.5 * kPi ? 1 : std::sin(half_turn),
                 versine = half_turn > 0.5 * kPi ? 2 : 1 - std::cos(half_turn), slack = level == 0 ? 0 : 1e-3;
    const double offset_x = (centre_.x - map_.origin().x()) * to_cells + x_.first,
                 offset_y = (centre_.y - map_.origin().y()) * to_cells + y_.first;
    const auto cellOf = [](double at) { return static_cast<int>(std::floor(std::clamp(at, -1e9, 1e9))); };
    for (const auto& point : points_) {
      const double x = (c * point.x() - s * point.y()) * to_cells, y = (s * point.x() + c * point.y()) * to_cells;
      const double sweep_x = std::abs(x) * versine + std::abs(y) * sine + slack,
                   sweep_y = std::abs(y) * versine + std::abs(x) * sine + slack;
      Sweep sweep{cellOf(x + offset_x - sweep_x), cellOf(y + offset_y - sweep_y), level};
      const int width = std::max(cellOf(x + offset_x + sweep_x) - sweep.x, cellOf(y + offset_y + sweep_y) - sweep.y);
      while (sweep.level < grid::LikelihoodPyramid::kLevels && (1 << sweep.level) < side + width) ++sweep.level;
      if (sweep.level < grid::LikelihoodPyramid::kLevels) {
        row.sweeps.push_back(sweep);
      } else {
        ++row.unbounded;
      }
    }
    return row;
  }

  const grid::LikelihoodPyramid& map_;
  const std::vector<Eigen::Vector2f>& points_;
  TPose2D centre_;
  double yaw_step_;  // [rad]
  Steps x_{0, 0}, y_{0, 0}, yaw_{0, 0};
  int top_ = 0;                         // level of the blocks that the search begins with
  std::vector<std::vector<Row>> rows_;  // by level and block of yaw; made when first needed
};

// The finite points in an order in which neighbours are far from each other, so that a sum over the first of them says
// much about the whole.
std::vector<Eigen::Vector2f> shuffled(const std::vector<Eigen::Vector2f>& points) {
  std::vector<Eigen::Vector2f> finite, result;
  for (const auto& point : points) {
    if (point.allFinite()) finite.push_back(point);
  }
  constexpr std::size_t kStride = 16;
  for (std::size_t first = 0; first < kStride; ++first) {
    for (std::size_t i = (first * 7) % kStride; i < finite.size(); i += kStride) result.push_back(finite[i]);
  }
  return result;
}

class Search {
 public:
  Search(const std::vector<SearchArea>& areas, const std::vector<Eigen::Vector2f>& scan_points,
         const SearchOptions& options)
      : points_(shuffled(scan_points)), options_(options), queue_(255 * static_cast<int>(points_.size())) {
    lattices_.reserve(areas.size());
    for (const SearchArea& area : areas) lattices_.emplace_back(area, points_);
    lowest_ = std::max(1, static_cast<int>(std::ceil(options.min_score * 255 * static_cast<double>(points_.size()))));
  }

  std::vector<SearchResult> run() {
    if (points_.empty() || options_.max_results < 1) return {};
    for (std::size_t i = 0; i < lattices_.size(); ++i) pushAll(static_cast<int>(i));
    Block block;
    std::size_t divided = 0;
    while (queue_.pop(lowest_, block)) {
      const Lattice& lattice = lattices_[block.area];
      const bool known = std::any_of(results_.begin(), results_.end(), [&](const SearchResult& result) {
        return static_cast<int>(result.area) == block.area && lattice.liesWithin(block, result.map_from_scan, options_);
      });
      if (known) continue;
      if (block.level > 0) {
        if (divided++ == options_.max_blocks) break;
        pushParts(block);
        continue;
      }
      const double all = 255.0 * static_cast<double>(points_.size());
      results_.push_back(
          {lattice.pose(block.x, block.y, block.yaw), block.bound / all, static_cast<std::size_t>(block.area)});
      if (results_.size() == static_cast<std::size_t>(options_.max_results)) break;
      lowest_ =
          std::max(lowest_, static_cast<int>(std::ceil(results_.front().score * all * options_.min_share_of_best)));
    }
    return results_;
  }

 private:
  void pushAll(int area) {
    Block block{};
    block.area = area;
    block.level = lattices_[area].top();
    const int side = 1 << block.level;
    for (block.yaw = 0; lattices_[area].holds(0, 0, block.yaw); block.yaw += side) {
      for (block.y = 0; lattices_[area].holds(0, block.y, 0); block.y += side) {
        for (block.x = 0; lattices_[area].holds(block.x, 0, 0); block.x += side)
          push(block, 255 * static_cast<int>(points_.size()));
      }
    }
  }

  void pushParts(const Block& block) {
    const int side = 1 << (block.level - 1);
    for (int i = 0; i < 8; ++i) {
      Block part = block;
      part.level = block.level - 1;
      part.x += (i & 1) * side;
      part.y += (i >> 1 & 1) * side;
      part.yaw += (i >> 2) * side;
      if (lattices_[block.area].holds(part.x, part.y, part.yaw)) push(part, block.bound);
    }
  }

  void push(Block block, int highest) {
    block.bound = std::min(highest, lattices_[block.area].bound(block, lowest_));
    if (block.bound >= lowest_) queue_.push(block);
  }

  std::vector<Eigen::Vector2f> points_;
  const SearchOptions options_;
  std::vector<Lattice> lattices_;
  Queue queue_;
  int lowest_;
  std::vector<SearchResult> results_;
};

}  // namespace

SearchWindow SearchWindow::everywhere(const grid::LikelihoodPyramid& map, double margin) {
  const Eigen::Vector2d middle = 0.5 * (map.low() + map.high()), half = 0.5 * (map.high() - map.low());
  return {{middle.x(), middle.y(), 0}, half.x() + margin, half.y() + margin, kPi};
}

std::vector<SearchResult> search(const std::vector<SearchArea>& areas, const std::vector<Eigen::Vector2f>& scan_points,
                                 const SearchOptions& options) {
  return Search(areas, scan_points, options).run();
}

std::vector<SearchResult> search(const grid::LikelihoodPyramid& map, const std::vector<Eigen::Vector2f>& scan_points,
                                 const SearchWindow& window, const SearchOptions& options) {
  return search({SearchArea{&map, window}}, scan_points, options);
}

double yawStep(const std::vector<Eigen::Vector2f>& scan_points, double cell) {
  double squares = 0;
  std::size_t count = 0;
  for (const auto& point : scan_points) {
    if (!point.allFinite()) continue;
    squares += point.cast<double>().squaredNorm();
    ++count;
  }
  const double range = count == 0 ? 0 : std::sqrt(squares / static_cast<double>(count));
  return cell / std::max(range, 4 * cell);
}

std::vector<Eigen::Vector2f> thinned(const std::vector<Eigen::Vector2f>& points, double spacing) {
  std::vector<Eigen::Vector2f> kept;
  for (const auto& point : points) {
    if (kept.empty() || !((point - kept.back()).norm() < spacing)) kept.push_back(point);
  }
  return kept;
}

}  // namespace omnimapper::matching
