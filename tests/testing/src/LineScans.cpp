#include <omnimapper/geometry/Angle.h>
#include <omnimapper/testing/LineScans.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace omnimapper::testing {

namespace {

using Eigen::Vector2d;
using geometry::kPi;

struct Side {
  Vector2d from, to;
  bool is_wall;
};

void addWalk(std::vector<Side>& sides, const std::vector<Vector2d>& corners, bool is_wall) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    sides.push_back({corners[i], corners[(i + 1) % corners.size()], is_wall});
}

// Adds a room around the origin with random orientation. One wall has a niche, another an open door without walls
// behind.
void addRoom(std::vector<Side>& sides, Dice& dice) {
  const double w = dice.uniform(2, 5), h = dice.uniform(2, 4), deep = dice.uniform(0.5, 1.5);
  const double left = dice.uniform(-0.8, -0.2) * w, right = left + dice.uniform(0.8, 1.6);
  const double turn = dice.uniform(0, 2 * kPi), low = dice.uniform(-0.6, 0.2) * h, high = low + 0.9;
  std::vector<Vector2d> corners{{w, -h},    {w, low},          {w + 0.15, low},  {w + 0.15, high}, {w, high}, {w, h},
                                {right, h}, {right, h + deep}, {left, h + deep}, {left, h},        {-w, h},   {-w, -h}};
  const Eigen::Rotation2Dd rotation(turn);
  for (auto& corner : corners) corner = rotation * corner;
  std::vector<Side> room;
  addWalk(room, corners, true);
  room.erase(room.begin() + 2);  // the open door
  sides.insert(sides.end(), room.begin(), room.end());
}

void addClutter(std::vector<Side>& sides, Dice& dice) {
  const double far = dice.uniform(0.8, 4), bearing = dice.uniform(0, 2 * kPi);
  const Vector2d middle(far * std::cos(bearing), far * std::sin(bearing));
  const bool is_box = dice.uniform(0, 1) < 0.4;
  const int corners = is_box ? 4 : 16;
  const double radius = is_box ? dice.uniform(0.08, 0.24) : dice.uniform(0.02, 0.15), turn = dice.uniform(0, kPi);
  std::vector<Vector2d> walk;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 2 * kPi * i / corners;
    walk.push_back(middle + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  addWalk(sides, walk, false);
}

struct Hit {
  double range = std::numeric_limits<double>::infinity();
  int side = -1;
};

Hit cast(const std::vector<Side>& sides, double angle) {
  const Vector2d u(std::cos(angle), std::sin(angle));
  Hit hit;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Vector2d along = sides[i].to - sides[i].from;
    const double cross = u.x() * along.y() - u.y() * along.x();
    if (std::abs(cross) < 1e-12) continue;
    const Vector2d& from = sides[i].from;
    const double range = (from.x() * along.y() - from.y() * along.x()) / cross;
    const double share = (from.x() * u.y() - from.y() * u.x()) / cross;
    if (range > 0 && share >= 0 && share <= 1 && range < hit.range) hit = {range, static_cast<int>(i)};
  }
  return hit;
}

Vector2d pointOf(const Hit& hit, double angle) {
  return {hit.range * std::cos(angle), hit.range * std::sin(angle)};
}

// The end of a visible wall: the corner that it shares with the side that the next beam hits, else the point that its
// last beam hit.
Vector2d endOf(const std::vector<Side>& sides, const std::vector<Hit>& hits, const std::vector<double>& angles,
               int last, int next) {
  const int neighbour = next >= 0 && next < static_cast<int>(hits.size()) ? hits[next].side : -1;
  if (neighbour >= 0 && neighbour != hits[last].side) {
    const Side &a = sides[hits[last].side], &b = sides[neighbour];
    if (a.to == b.from) return a.to;
    if (a.from == b.to) return a.from;
  }
  return pointOf(hits[last], angles[last]);
}

// Adds the visible parts of a wall. If it is hidden over more than the largest gap, its visible parts are two walls.
void addVisibleParts(LineScan& result, const std::vector<Side>& sides, const std::vector<Hit>& hits,
                     const std::vector<double>& angles, int side, const LineScanOptions& options) {
  std::vector<int> run;
  const auto finish = [&] {
    if (run.size() >= 2) {
      const geometry::Segment2 visible{endOf(sides, hits, angles, run.front(), run.front() - 1),
                                       endOf(sides, hits, angles, run.back(), run.back() + 1)};
      const bool is_long =
          length(visible) >= options.shortest + 0.05 && static_cast<int>(run.size()) >= options.fewest + 2;
      result.walls.push_back({visible, is_long});
    }
    run.clear();
  };
  for (int i = 0; i < static_cast<int>(hits.size()); ++i) {
    if (hits[i].side != side || hits[i].range >= options.max_range) continue;
    if (!run.empty() && i - run.back() > 1 &&
        (pointOf(hits[i], angles[i]) - pointOf(hits[run.back()], angles[run.back()])).norm() > options.gap)
      finish();
    run.push_back(i);
  }
  finish();
}

}  // namespace

LineScan drawLineScan(const LineScanOptions& options, Dice& dice) {
  std::vector<Side> sides;
  addRoom(sides, dice);
  for (int i = 0; i < options.clutter; ++i) addClutter(sides, dice);
  LineScan result;
  result.scan.aperture = static_cast<float>(options.aperture);
  result.scan.maxRange = static_cast<float>(options.max_range);
  result.scan.rightToLeft = true;
  result.scan.sensorLabel = "laser";
  result.scan.timestamp = base::stampFromUnix(1.7e9);
  result.scan.resizeScan(static_cast<std::size_t>(options.beams));
  std::vector<Hit> hits;
  std::vector<double> angles;
  for (int i = 0; i < options.beams; ++i) {
    angles.push_back(result.scan.aperture * (i / (options.beams - 1.0) - 0.5));
    hits.push_back(cast(sides, angles.back()));
  }
  for (int i = 0; i < options.beams; ++i) {
    double range = hits[i].range;
    if (i + 1 < options.beams && std::abs(hits[i + 1].range - range) > 0.3 && std::isfinite(hits[i + 1].range) &&
        dice.uniform(0, 1) < options.mixed)
      range += dice.uniform(0, 1) * (hits[i + 1].range - range);
    range += dice.normal(options.sigma);
    const bool is_lost = dice.uniform(0, 1) < options.lost;
    const auto index = static_cast<std::size_t>(i);
    result.scan.setScanRange(index, std::isfinite(range) ? static_cast<float>(range) : 0.F);
    result.scan.setScanRangeValidity(index, !is_lost && range < options.max_range && range > 0.05);
  }
  for (std::size_t side = 0; side < sides.size(); ++side) {
    if (sides[side].is_wall) addVisibleParts(result, sides, hits, angles, static_cast<int>(side), options);
  }
  return result;
}

void LineScore::add(const LineScan& truth, const std::vector<geometry::Segment2>& found) {
  struct Match {
    double common = 0, together = 1;
    const geometry::Segment2* line = nullptr;
  };
  std::vector<Match> best(truth.walls.size());
  for (const auto& line : found) {
    ++lines;
    bool is_right = false;
    for (std::size_t k = 0; k < truth.walls.size(); ++k) {
      const auto& wall = truth.walls[k].visible;
      const Vector2d along = direction(wall), across(-along.y(), along.x());
      if (std::abs(direction(line).dot(across)) > std::sin(2 * kPi / 180)) continue;
      if (std::abs((middle(line) - wall.from).dot(across)) > 0.03) continue;
      double low = (line.from - wall.from).dot(along), high = (line.to - wall.from).dot(along);
      if (low > high) std::swap(low, high);
      const double common = std::min(high, length(wall)) - std::max(low, 0.0);
      if (common <= 0) continue;
      is_right = is_right || common > 0.5 * (high - low);
      const double together = std::max(high, length(wall)) - std::min(low, 0.0);
      if (common / together > best[k].common / best[k].together) best[k] = {common, together, &line};
    }
    right_lines += is_right;
  }
  for (std::size_t k = 0; k < truth.walls.size(); ++k) {
    if (!truth.walls[k].is_long) continue;
    ++walls;
    const auto& wall = truth.walls[k].visible;
    if (!best[k].line || best[k].common < 0.5 * best[k].together) continue;
    ++found_walls;
    const bool same_direction = direction(wall).dot(direction(*best[k].line)) > 0;
    const auto &from = same_direction ? best[k].line->from : best[k].line->to,
               &to = same_direction ? best[k].line->to : best[k].line->from;
    end_errors.push_back((from - wall.from).norm());
    end_errors.push_back((to - wall.to).norm());
  }
}

double LineScore::meanEndError() const {
  double sum = 0;
  for (const double error : end_errors) sum += error;
  return end_errors.empty() ? 0 : sum / static_cast<double>(end_errors.size());
}

}  // namespace omnimapper::testing
