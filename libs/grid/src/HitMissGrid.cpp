#include <omnimapper/base/Error.h>
#include <omnimapper/grid/GridWalk.h>
#include <omnimapper/grid/HitMissGrid.h>
#include <omnimapper/grid/LikelihoodPyramid.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace omnimapper::grid {

using mrpt::math::TPose2D;

namespace {

constexpr std::uint16_t kMostCounts = 60000;  // largest value of a count

class Mover {
 public:
  explicit Mover(const TPose2D& a_from_b) : pose_(a_from_b), c_(std::cos(pose_.phi)), s_(std::sin(pose_.phi)) {}
  Eigen::Vector2d operator()(const Eigen::Vector2f& p) const {
    return {pose_.x + c_ * p.x() - s_ * p.y(), pose_.y + s_ * p.x() + c_ * p.y()};
  }

 private:
  TPose2D pose_;
  double c_, s_;
};

}  // namespace

HitMissGrid::HitMissGrid(const std::vector<Placed>& scans, const BeamModel& model) : model_(model) {
  Eigen::Vector2d low(INFINITY, INFINITY), high = -low;
  std::vector<Eigen::Vector2f> hits;
  for (const Placed& placed : scans) {
    const Mover map_from_sensor(placed.map_from_sensor);
    const auto include = [&](const Eigen::Vector2f& point) {
      const Eigen::Vector2d moved = map_from_sensor(point);
      low = low.cwiseMin(moved);
      high = high.cwiseMax(moved);
      return moved;
    };
    include({0, 0});
    for (const auto& point : placed.scan->hits) hits.push_back(include(point).cast<float>());
    for (const auto& point : placed.scan->misses) include(point);
  }
  if (!(low.x() <= high.x())) return;
  origin_ = low.array() - model.cell;
  const Eigen::Vector2d size = ((high - origin_) / model.cell).array() + 2;
  if (!(size.prod() <= static_cast<double>(model.max_cells))) {
    throw base::Error(base::ExitCode::out_of_range, "A grid of beams has more than " + std::to_string(model.max_cells) +
                                                        " cells: make the cells larger or the map smaller");
  }
  width_ = static_cast<int>(size.x());
  height_ = static_cast<int>(size.y());
  cells_.resize(static_cast<std::size_t>(width_) * height_);
  for (const Placed& placed : scans) add(placed);
  LikelihoodOptions wall;
  wall.cell = model.cell;
  wall.sigma = model.near_wall;
  wall.levels = 1;
  wall.max_cells = model.max_cells;
  walls_ = std::make_unique<const LikelihoodPyramid>(hits, wall);
}

void HitMissGrid::add(const Placed& placed) {
  const Mover map_from_sensor(placed.map_from_sensor);
  const auto inCells = [&](const Eigen::Vector2f& point) -> Eigen::Vector2d {
    return (map_from_sensor(point) - origin_) / model_.cell;
  };
  const Eigen::Vector2d from = inCells({0, 0});
  const auto cell = [&](int x, int y) -> Cell& { return cells_[static_cast<std::size_t>(y) * width_ + x]; };
  const auto pass = [&](const Eigen::Vector2d& to) {
    walk(from, to, [&](int x, int y) {
      Cell& passed = cell(x, y);
      if (passed.passes < kMostCounts) ++passed.passes;
      return true;
    });
  };
  for (const auto& point : placed.scan->hits) {
    const Eigen::Vector2d to = inCells(point);
    pass(to);
    Cell& end = cell(static_cast<int>(to.x()), static_cast<int>(to.y()));
    if (end.hits < kMostCounts) ++end.hits;
  }
  for (const auto& point : placed.scan->misses) pass(inCells(point));
}

// Likelihood of a beam; its ends are in cells.
double HitMissGrid::beam(const Eigen::Vector2d& from, const Eigen::Vector2d& to, bool hit) const {
  const Eigen::Vector2d delta = to - from;
  const double length = delta.norm(), checked = length - model_.tolerance / model_.cell;
  double open = 1;
  if (checked > 0) {
    walkInside(from, from + delta * (checked / length), width_, height_, [&](int x, int y) {
      const Cell* cell = at(x, y);
      if (cell && cell->hits > 0) open *= (cell->passes + 0.5) / (cell->passes + cell->hits + 0.5);
      return open > 0.01;
    });
  }
  double end = 1;
  if (hit) {
    const bool is_inside = to.x() >= 0 && to.y() >= 0 && to.x() < width_ && to.y() < height_;
    const Cell* cell = is_inside ? at(static_cast<int>(to.x()), static_cast<int>(to.y())) : nullptr;
    const double near = cell && walls_ ? walls_->at(origin_ + to * model_.cell) / 255.0 : 0;
    end = std::max(near, cell && cell->passes + cell->hits > 0 ? model_.clutter : model_.unknown);
  }
  return std::max(model_.anything, open * end);
}

std::vector<double> HitMissGrid::logLikelihoods(const BeamScan& scan, const TPose2D& map_from_sensor) const {
  const Mover mover(map_from_sensor);
  const auto inCells = [&](const Eigen::Vector2f& point) -> Eigen::Vector2d {
    return (mover(point) - origin_) / model_.cell;
  };
  const Eigen::Vector2d from = inCells({0, 0});
  std::vector<double> logarithms;
  logarithms.reserve(scan.hits.size() + scan.misses.size());
  for (const auto& point : scan.hits) logarithms.push_back(std::log(beam(from, inCells(point), true)));
  for (const auto& point : scan.misses) logarithms.push_back(std::log(beam(from, inCells(point), false)));
  return logarithms;
}

double HitMissGrid::logLikelihood(const BeamScan& scan, const TPose2D& map_from_sensor) const {
  const auto logarithms = logLikelihoods(scan, map_from_sensor);
  const double sum = std::accumulate(logarithms.begin(), logarithms.end(), 0.0);
  return logarithms.empty() ? 0 : sum / static_cast<double>(logarithms.size());
}

}  // namespace omnimapper::grid
