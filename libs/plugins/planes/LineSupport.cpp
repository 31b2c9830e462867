#include "LineSupport.h"

#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

namespace {

using derived::Cell;
using Eigen::Vector2d;
using Stretch = LineSupport::Stretch;

Cell cellAt(const derived::ScanGrid& grid, const Vector2d& point) {
  const double column = std::floor((point.x() - grid.min_x) / grid.resolution),
               row = std::floor((point.y() - grid.min_y) / grid.resolution);
  const bool is_inside = column >= 0 && column < grid.columns && row >= 0 && row < grid.rows;
  return is_inside ? grid.at(static_cast<int>(column), static_cast<int>(row)) : Cell::unknown;
}

// What stands at a point of a line: occupied if any cell across the line is.
Cell acrossAt(const derived::ScanGrid& grid, const Vector2d& point, const Vector2d& across) {
  constexpr double kReach = 0.15;  // [m]
  const Cell there = cellAt(grid, point);
  for (double off = 0; off <= kReach; off += grid.resolution / 2)
    for (const double side : {-off, off})
      if (cellAt(grid, point + side * across) == Cell::occupied) return Cell::occupied;
  return there;
}

// Where the base crossed the line, as distances from its begin.
std::vector<double> crossingsOf(const geometry::Segment2& line, const map::KeyFrames& key_frames) {
  constexpr double kLongestStep = 2;  // [m]
  const Vector2d along = line.to - line.from;
  const auto cross = [](const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  std::vector<double> crossings;
  std::optional<Vector2d> last;
  std::uint16_t session = 0;
  for (const auto& frame : key_frames) {
    const Vector2d at(frame.map_from_base.x(), frame.map_from_base.y());
    if (last && frame.id.session == session && (at - *last).norm() <= kLongestStep) {
      const Vector2d step = at - *last;
      const double turn = cross(along, step);
      const double on_line = turn != 0 ? cross(*last - line.from, step) / turn : -1,
                   on_step = turn != 0 ? cross(*last - line.from, along) / turn : -1;
      if (on_line >= 0 && on_line <= 1 && on_step >= 0 && on_step <= 1) crossings.push_back(on_line * along.norm());
    }
    last = at;
    session = frame.id.session;
  }
  return crossings;
}

struct Samples {
  std::vector<Cell> cells;
  double step = 0;  // [m]
};

Samples samplesOf(const geometry::Segment2& line, const derived::ScanGrid& grid, const map::KeyFrames& key_frames) {
  constexpr double kBase = 0.15;  // [m] half of what the base needs at least
  constexpr double kMost = 1e5;   // samples
  Samples samples;
  const double length = geometry::length(line);
  const double count = std::ceil(std::clamp(2 * length / grid.resolution, 1.0, kMost));
  samples.step = length / count;
  const Vector2d along = geometry::direction(line), across(-along.y(), along.x());
  for (double i = 0; i < count; ++i)
    samples.cells.push_back(acrossAt(grid, line.from + (i + 0.5) * samples.step * along, across));
  for (const double crossing : crossingsOf(line, key_frames)) {
    const auto first = static_cast<std::ptrdiff_t>(std::max(0.0, std::floor((crossing - kBase) / samples.step)));
    const auto end = static_cast<std::ptrdiff_t>(std::min(count, std::ceil((crossing + kBase) / samples.step)));
    std::fill(samples.cells.begin() + first, samples.cells.begin() + std::max(first, end), Cell::free);
  }
  return samples;
}

/// Samples [begin, end), of which the first and the last are occupied, and how many of them are occupied and free.
struct Run {
  std::size_t begin = 0, end = 0, occupied = 0, free = 0;
};

// Runs between whose occupied samples there are fewer than `gap` free ones.
std::vector<Run> runsOf(const std::vector<Cell>& cells, std::size_t gap) {
  std::vector<Run> runs;
  std::size_t free = 0;  // since the last occupied sample
  for (std::size_t i = 0; i < cells.size(); ++i) {
    free += cells[i] == Cell::free;
    if (cells[i] != Cell::occupied) continue;
    if (runs.empty() || free >= gap) {
      runs.push_back({i, i, 0, 0});
    } else {
      runs.back().free += free;
    }
    free = 0;
    runs.back().end = i + 1;
    ++runs.back().occupied;
  }
  return runs;
}

}  // namespace

std::optional<std::vector<Stretch>> LineSupport::stretchesOf(const geometry::Segment2& line) const {
  constexpr double kGap = 0.3, kLeast = 0.5, kEnd = 0.15;  // [m]
  constexpr double kDense = 0.5;
  const Samples samples = samplesOf(line, *grid_, *key_frames_);
  const auto is_seen = [](Cell cell) { return cell != Cell::unknown; };
  if (std::none_of(samples.cells.begin(), samples.cells.end(), is_seen)) return std::nullopt;
  const auto gap = static_cast<std::size_t>(std::max(1.0, std::round(kGap / samples.step)));
  std::vector<Stretch> stretches;
  const double whole = geometry::length(line);
  for (const Run& run : runsOf(samples.cells, gap)) {
    const double from = static_cast<double>(run.begin) * samples.step, to = static_cast<double>(run.end) * samples.step;
    const auto seen = static_cast<double>(run.occupied + run.free);
    if (to - from < kLeast || static_cast<double>(run.occupied) < kDense * seen) continue;
    // Near its ends the line is known better than by cells.
    stretches.emplace_back(from < kEnd ? 0 : from, to > whole - kEnd ? whole : to);
  }
  return stretches;
}

}  // namespace omnimapper::plugins
