#include "WallFit.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "Quantile.h"

namespace omnimapper::check {

namespace {

using Eigen::Vector3d;

constexpr double kOneDegree = base::option_text::kRadiansPerDegree;
constexpr double kUpright = 12 * kOneDegree;

// An equation `row` . x = value, and what it weighs.
struct Equation {
  Eigen::Vector3d row;
  double value, weight;
};

struct Solution {
  Eigen::Vector3d x;
  Eigen::Matrix3d covariance;
  std::size_t used;  // equations
};

// Least squares from a first solution. Equations with large residuals are left out round by round, so that planes that
// were paired with another wall do not count. `prior` holds how far each unknown may be from its first value [standard
// deviations as of the unknown].
std::optional<Solution> solve(const std::vector<Equation>& equations, const Eigen::Vector3d& first,
                              const Eigen::Vector3d& prior, double least_sigma) {
  Solution solution{first, Eigen::Matrix3d::Identity(), 0};
  for (int round = 0; round < 6; ++round) {
    std::vector<double> residuals;
    for (const auto& one : equations) residuals.push_back(std::abs(one.value - one.row.dot(solution.x)));
    if (residuals.size() < kFewestWalls) return std::nullopt;
    const double sigma = std::max(least_sigma, 1.4826 * quantile(residuals, 0.5)), limit = 3 * sigma;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      normal(i, i) = sigma * sigma / (prior[i] * prior[i]);
      right[i] = normal(i, i) * first[i];
    }
    std::size_t used = 0;
    for (std::size_t i = 0; i < equations.size(); ++i) {
      if (residuals[i] > limit) continue;
      const auto& one = equations[i];
      normal += one.weight * one.row * one.row.transpose();
      right += one.weight * one.row * one.value;
      ++used;
    }
    if (used < kFewestWalls) return std::nullopt;
    solution.x = normal.ldlt().solve(right);
    solution.covariance = sigma * sigma * normal.inverse();
    solution.used = used;
  }
  return solution;
}

Measured measured(const Solution& solution, Eigen::Index i) {
  return {solution.x[i], std::sqrt(std::max(0.0, solution.covariance(i, i)))};
}

}  // namespace

WallFit::WallFit(const std::vector<View>& views, const CameraWitness& witness, const Eigen::Matrix3d& level_from_sensor,
                 const Vector3d& position)
    : views_(views), witness_(witness), position_(position) {
  const Vector3d axis = level_from_sensor * Vector3d::UnitX();
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (witness.walls(views[i].stamp).empty()) continue;
    for (const auto& [plane, sigma] : views[i].planes) {
      const Vector3d normal = level_from_sensor * plane.normal;
      if (std::abs(normal.z()) > std::sin(kUpright)) continue;
      const double azimuth = std::atan2(-normal.y(), -normal.x());
      const double bearing = mrpt::math::wrapToPi(azimuth - std::atan2(axis.y(), axis.x()));
      walls_.push_back({i, azimuth, bearing, plane.distance, sigma});
    }
  }
}

std::vector<std::vector<BaseWall>> WallFit::lasersAt(double clock) const {
  std::vector<std::vector<BaseWall>> all;
  for (const auto& view : views_) all.push_back(witness_.walls(view.stamp - base::durationFromSeconds(clock)));
  return all;
}

// [m] of the wall of the laser from the sensor.
double WallFit::distanceOf(const BaseWall& laser) const {
  return laser.distance - std::cos(laser.azimuth) * position_.x() - std::sin(laser.azimuth) * position_.y();
}

// The yaw and the logarithm of the scale with which the two are one wall; NaN if they cannot be one.
std::pair<double, double> WallFit::pairing(const CameraWall& wall, const BaseWall& laser) const {
  const double distance = distanceOf(laser);
  if (distance < 0.1 || wall.distance <= 0) return {0, std::nan("")};
  return {mrpt::math::wrapToPi(laser.azimuth - wall.azimuth), std::log(distance / wall.distance)};
}

// The yaw and the scale for which most planes vote if the images are late by `clock` [s].
WallFit::Vote WallFit::vote(double clock) const {
  constexpr double kYawBin = 3 * kOneDegree, kScaleBin = 0.06;
  std::map<std::pair<int, int>, std::vector<std::size_t>> bins;  // walls of the camera
  const int turns = static_cast<int>(std::lround(2 * M_PI / kYawBin));
  const auto laser = lasersAt(clock);
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    for (const auto& other : laser[walls_[i].view]) {
      const auto [yaw, log_scale] = pairing(walls_[i], other);
      if (std::isnan(log_scale)) continue;
      const int a = static_cast<int>(std::floor(yaw / kYawBin)),
                b = static_cast<int>(std::floor(log_scale / kScaleBin));
      // Each pair votes for four overlapping bins, so that no cluster is cut in two.
      for (int da = 0; da < 2; ++da) {
        for (int db = 0; db < 2; ++db) {
          auto& bin = bins[{((a + da) % turns + turns) % turns, b + db}];
          if (bin.empty() || bin.back() != i) bin.push_back(i);
        }
      }
    }
  }
  Vote best;
  double best_score = 0;
  for (const auto& [bin, planes] : bins) {
    const double yaw = mrpt::math::wrapToPi(bin.first * kYawBin), log_scale = bin.second * kScaleBin;
    // What is declared is more likely than what is far from it.
    const double score = static_cast<double>(planes.size()) - 0.5 * std::min(1.0, std::abs(yaw)) -
                         0.5 * std::min(1.0, std::abs(log_scale));
    if (score <= best_score) continue;
    best_score = score;
    best = {yaw, log_scale, planes.size()};
  }
  return best;
}

std::vector<WallFit::Match> WallFit::matches(double yaw, double log_scale, double clock, double focal_slope) const {
  constexpr double kYaw = 6 * kOneDegree, kLogScale = 0.1;
  const auto laser = lasersAt(clock);
  std::vector<Match> matches;
  for (const auto& wall : walls_) {
    double best = 1;
    const BaseWall* found = nullptr;
    for (const auto& other : laser[wall.view]) {
      const auto [turn, scale] = pairing(wall, other);
      if (std::isnan(scale)) continue;
      const double off = mrpt::math::wrapToPi(turn - yaw - focal_slope * 0.5 * std::sin(2 * wall.bearing));
      const double cost = std::hypot(off / kYaw, (scale - log_scale) / kLogScale);
      if (cost >= best) continue;
      best = cost;
      found = &other;
    }
    if (found) matches.push_back({&wall, *found});
  }
  return matches;
}

// Yaw, clock and focal length by least squares, and the scale, from the pairs near `start`. Returns the number of pairs
// that agree closely.
std::size_t WallFit::refine(const Vote& start, double clock, CameraFacts& facts) const {
  constexpr double kAngleSigma = 0.2 * kOneDegree, kDistanceSigma = 0.005;  // [rad] [m] of a plane and a line at best
  constexpr double kAnything = 10, kPlace = 0.03, kClock = 0.5, kFocal = 0.5;
  // Planes of one image share errors, such as those of the pose at which it was taken.
  constexpr double kShared = 1.5;
  double yaw = start.yaw, focal_slope = 0, scale = std::exp(start.log_scale);
  std::optional<Solution> angles, distances;
  for (int round = 0; round < 4; ++round) {
    const auto pairs = matches(yaw, std::log(scale), clock, focal_slope);
    std::vector<Equation> turns, places;
    for (const auto& [wall, laser] : pairs) {
      const auto rate = witness_.turning(views_[wall->view].stamp - base::durationFromSeconds(clock));
      const double weight = 1 / (1 + mrpt::square(wall->sigma / kOneDegree));
      turns.push_back({{1, rate.value_or(0), 0.5 * std::sin(2 * wall->bearing)},
                       mrpt::math::wrapToPi(laser.azimuth - wall->azimuth - yaw) + yaw,
                       weight});
      places.push_back({{wall->distance, std::cos(laser.azimuth), std::sin(laser.azimuth)}, distanceOf(laser), weight});
    }
    angles = solve(turns, {yaw, 0, focal_slope}, {kAnything, kClock, kFocal}, kAngleSigma);
    distances = solve(places, {scale, 0, 0}, {kAnything * scale, kPlace, kPlace}, kDistanceSigma);
    facts.matched = pairs.size();
    if (!angles || !distances) return 0;
    yaw = angles->x[0];
    focal_slope = angles->x[2];
    scale = distances->x[0];
    if (!(scale > 0)) return 0;
    // Walls of the laser at too late a time are turned back by as much as the base turned on until then.
    clock -= std::clamp(angles->x[1], -0.5, 0.5);
  }
  angles->covariance *= kShared * kShared;
  distances->covariance *= kShared * kShared;
  facts.yaw = measured(*angles, 0);
  facts.clock = Measured{clock, measured(*angles, 1).sigma};
  facts.scale = measured(*distances, 0);
  const auto slope = measured(*angles, 2);
  facts.focal = Measured{std::exp(slope.value), slope.sigma * std::exp(slope.value)};
  return angles->used;
}

// With a clock that is a little wrong, the planes that were seen in turns are left out as if they were wrong pairs. So
// least squares begins at several clocks.
void WallFit::measure(CameraFacts& facts) const {
  constexpr double kFarthest = 6, kStep = 0.1;  // [s]
  constexpr double kMuchBetter = 1.25;
  double clock = 0;
  auto best = vote(0);
  for (double other = -kFarthest; other <= kFarthest; other += kStep) {
    const auto some = vote(other);
    const bool is_first = clock == 0;
    const double needed = (is_first ? kMuchBetter : 1.0) * static_cast<double>(best.planes) + (is_first ? 1 : 0);
    if (static_cast<double>(some.planes) <= needed) continue;
    best = some;
    clock = other;
  }
  facts.matched = best.planes;
  if (best.planes < kFewestWalls) return;
  std::size_t most = 0;
  for (const double start : {0.0, -0.1, 0.1, -0.2, 0.2}) {
    CameraFacts some = facts;
    const auto used = refine(best, clock + start, some);
    if (10 * used <= 11 * most) continue;
    most = used;
    facts = some;
  }
}

}  // namespace omnimapper::check
