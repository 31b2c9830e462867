#include "compareMotions.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "Quantile.h"

namespace omnimapper::check {

namespace {

using mrpt::poses::CPose2D;
using Mounting = MotionFacts::Mounting;

constexpr double kMoved = 0.1, kTurned = 0.1;  // [m] [rad] smallest motion that a match distinguishes from rest
constexpr double kStillTravel = 1e-4, kStillTurn = 1e-4;
constexpr std::size_t kFewestMotions = 8;
constexpr double kMatchSigma = 0.01;        // [m] standard deviation of a good match
constexpr double kMatchAngleSigma = 0.003;  // [rad]

// Rows of the equations R(yaw) t_scans - (R_odometry - 1) c = t_odometry, in (a, b, c_x, c_y) with a = s cos yaw, b = s
// sin yaw. They hold because the motion of the true base and that of the base by the reported sensor pose are
// conjugate.
struct Rows {
  Eigen::Matrix<double, 2, 4> left;
  Eigen::Vector2d right;
};

Rows rowsOf(const MatchedMotion& motion) {
  const CPose2D& o = *motion.by_odometry;
  const double x = motion.by_scans.x(), y = motion.by_scans.y();
  const double c = std::cos(o.phi()) - 1, s = std::sin(o.phi());
  Rows rows;
  rows.left << x, -y, -c, s, y, x, -s, -c;
  rows.right << o.x(), o.y();
  return rows;
}

struct Fit {
  Eigen::Vector4d solution = Eigen::Vector4d(1, 0, 0, 0);
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();
};

std::vector<double> residuals(const std::vector<Rows>& rows, const Eigen::Vector4d& solution) {
  std::vector<double> all;
  for (const auto& row : rows) all.push_back((row.left * solution - row.right).norm());
  return all;
}

// Least squares, repeated without outliers such as slips and wrong matches.
std::optional<Fit> fit(const std::vector<Rows>& rows) {
  Fit result;
  double limit = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 4; ++round) {
    const auto off = residuals(rows, result.solution);
    Eigen::Matrix4d normal = Eigen::Matrix4d::Identity() * 1e-6;
    Eigen::Vector4d right = normal * Eigen::Vector4d(1, 0, 0, 0);
    double squared = 0;
    std::size_t used = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (round > 0 && off[i] > limit) continue;
      normal += rows[i].left.transpose() * rows[i].left;
      right += rows[i].left.transpose() * rows[i].right;
      squared += off[i] * off[i];
      ++used;
    }
    if (used < kFewestMotions) return std::nullopt;
    result.solution = normal.ldlt().solve(right);
    const double variance = std::max(kMatchSigma * kMatchSigma, squared / (2 * static_cast<double>(used)));
    result.covariance = variance * normal.inverse();
    limit = std::max(3 * kMatchSigma, 3 * quantile(residuals(rows, result.solution), 0.5));
  }
  return result;
}

std::optional<Mounting> mountingOf(const std::vector<MatchedMotion>& motions) {
  std::vector<Rows> rows;
  for (const auto& motion : motions) rows.push_back(rowsOf(motion));
  const auto found = fit(rows);
  if (!found) return std::nullopt;
  const auto& s = found->solution;
  Mounting mounting;
  mounting.scale = s.head<2>().norm();
  if (mounting.scale < 0.1) return std::nullopt;  // the odometry measures no translation
  mounting.yaw = std::atan2(s[1], s[0]);
  mounting.x = s[2];
  mounting.y = s[3];
  mounting.position_sigma = std::sqrt(std::max(found->covariance(2, 2), found->covariance(3, 3)));
  mounting.yaw_sigma = std::sqrt(std::max(found->covariance(0, 0), found->covariance(1, 1))) / mounting.scale;
  return mounting;
}

// Standard deviation after one unit of travel or turn, estimated robustly from the median of squared errors per unit.
std::optional<double> noiseOf(const std::vector<double>& squared_per_unit, double chi2_median) {
  if (squared_per_unit.size() < kFewestMotions) return std::nullopt;
  return std::sqrt(std::max(0.0, quantile(squared_per_unit, 0.5) / chi2_median));
}

void measureNoise(const std::vector<MatchedMotion>& motions, const CPose2D& mounting, MotionFacts& facts) {
  constexpr double kChi2Of1 = 0.455, kChi2Of2 = 1.386;  // medians
  std::vector<double> positions, turns, headings;
  for (const auto& motion : motions) {
    const CPose2D base = mounting + motion.by_scans + (CPose2D() - mounting);
    const CPose2D error = base - *motion.by_odometry;
    const double travel = base.norm(), turn = std::abs(base.phi());
    const double position = std::max(0.0, error.norm() * error.norm() - 2 * kMatchSigma * kMatchSigma);
    const double yaw = std::max(0.0, error.phi() * error.phi() - kMatchAngleSigma * kMatchAngleSigma);
    if (travel > kMoved) positions.push_back(position / travel);
    if (turn > kTurned) turns.push_back(yaw / turn);
    if (travel > kMoved && turn < kTurned / 2) headings.push_back(yaw / travel);
  }
  facts.position_noise_per_root_m = noiseOf(positions, kChi2Of2);
  facts.yaw_noise_per_root_turn = noiseOf(turns, kChi2Of1);
  facts.yaw_noise_per_root_m = noiseOf(headings, kChi2Of1);
}

bool hasMoved(const CPose2D& motion) {
  return motion.norm() > kMoved || std::abs(motion.phi()) > kTurned;
}

bool isStill(const CPose2D& motion) {
  return motion.norm() < kStillTravel && std::abs(motion.phi()) < kStillTurn;
}

void countDirections(const MatchedMotion& motion, MotionFacts& facts) {
  const CPose2D &a = motion.by_scans, &b = *motion.by_odometry;
  if (std::abs(a.x()) > kMoved / 2 && std::abs(b.x()) > kMoved / 2) {
    ++facts.forward;
    if (a.x() * b.x() < 0) ++facts.forward_reversed;
  }
  if (std::abs(a.phi()) > kTurned / 2 && std::abs(b.phi()) > kTurned / 2) {
    ++facts.turning;
    if (a.phi() * b.phi() < 0) ++facts.turning_reversed;
  }
}

// Turn by odometry divided by turn by scans: the median over all pairs that turn.
std::optional<double> turnScaleOf(const std::vector<MatchedMotion>& motions) {
  std::vector<double> ratios;
  for (const auto& motion : motions) {
    const double by_scans = motion.by_scans.phi(), by_odometry = motion.by_odometry->phi();
    if (std::abs(by_scans) > kTurned && std::abs(by_odometry) > kTurned) ratios.push_back(by_odometry / by_scans);
  }
  if (ratios.size() < kFewestMotions) return std::nullopt;
  return quantile(ratios, 0.5);
}

// The odometry's motions at the moments of the scans, if the clocks of both differ.
std::optional<ClockFacts> alignClocks(std::vector<MatchedMotion>& motions, const OdometryBetween& odometry,
                                      const Headings& headings) {
  const auto clock = fitClock(turnsOf(motions), headings);
  if (!clock || !clock->isWrong()) return clock;
  const auto shift = base::durationFromSeconds(clock->offset);
  for (auto& motion : motions) motion.by_odometry = odometry(motion.begin + shift, motion.end + shift);
  return clock;
}

MotionFacts compare(const std::vector<MatchedMotion>& motions) {
  MotionFacts facts;
  facts.matched = motions.size();
  std::vector<double> speeds, wall_distances;
  std::vector<MatchedMotion> comparable;  // those for which the odometry shows motion too
  for (const auto& motion : motions) {
    speeds.push_back(motion.by_scans.norm() / motion.seconds());
    wall_distances.push_back(motion.wall_distance);
    const bool moved = hasMoved(motion.by_scans);
    facts.moved += moved;
    if (!motion.by_odometry) continue;
    if (moved && isStill(*motion.by_odometry)) {
      if (facts.frozen++ == 0) facts.first_frozen = motion.begin;
      continue;
    }
    countDirections(motion, facts);
    if (moved) comparable.push_back(motion);
  }
  if (!speeds.empty()) facts.speed = quantile(speeds, 0.9);
  if (!wall_distances.empty()) facts.wall_distance = quantile(wall_distances, 0.5);
  facts.turn_scale = turnScaleOf(comparable);
  facts.mounting = mountingOf(comparable);
  const auto& mounting = facts.mounting;
  measureNoise(comparable, mounting ? CPose2D(mounting->x, mounting->y, mounting->yaw) : CPose2D(), facts);
  return facts;
}

}  // namespace

// The turns of the odometry, which have errors too, only raise the suspicion that the declared aperture is wrong. The
// right one is that with which the scans match best. It was found this way on five real logs of 180 deg and one of 220
// deg that were declared as 90 and 270 (mit-csail, intel, aces, fhw, belgioioso, driving_in_office).
ComparedMotions compareMotions(const std::vector<ScanPair>& pairs, double aperture, const OdometryBetween& odometry,
                               const Headings& headings) {
  constexpr double kWrong = 0.15;       // turn by odometry divided by turn by scans, minus 1
  constexpr double kFitsBetter = 0.95;  // factor on the distance from the walls
  constexpr double kFewer = 0.9;        // share of the matched pairs
  ComparedMotions declared{{}, matchPairs(pairs, odometry)};
  const auto clock = alignClocks(declared.motions, odometry, headings);
  auto& facts = declared.facts;
  facts = compare(declared.motions);
  facts.clock = clock;
  const auto excess = [](const MotionFacts& some) { return std::abs(some.turn_scale.value_or(0) - 1); };
  if (!facts.turn_scale || excess(facts) < kWrong) return declared;
  // Apertures of lasers on the market, and the one that the odometry suggests if it is none of these.
  std::vector<double> apertures;
  for (const double sold : {90, 100, 120, 180, 190, 220, 240, 270, 360}) {  // [deg]
    apertures.push_back(sold * base::option_text::kRadiansPerDegree);
  }
  const double by_turning = std::min(aperture * std::abs(*facts.turn_scale), 2 * M_PI);
  if (std::none_of(apertures.begin(), apertures.end(),
                   [&](double sold) { return std::abs(sold - by_turning) < 0.05 * sold; })) {
    apertures.push_back(by_turning);
  }
  const auto shift = base::durationFromSeconds(clock && clock->isWrong() ? clock->offset : 0);
  const auto at_scans = [&](base::Stamp begin, base::Stamp end) { return odometry(begin + shift, end + shift); };
  std::optional<ComparedMotions> best;
  for (const double other : apertures) {
    ComparedMotions with{{}, matchPairs(withAperture(pairs, other), at_scans)};
    with.facts = compare(with.motions);
    if (static_cast<double>(with.facts.matched) < kFewer * static_cast<double>(facts.matched)) continue;
    with.facts.aperture = other;
    with.facts.clock = clock;
    if (!best || with.facts.wall_distance < best->facts.wall_distance) best = std::move(with);
  }
  const bool is_better = best && best->facts.wall_distance < kFitsBetter * facts.wall_distance &&
                         excess(best->facts) < 0.5 * excess(facts) &&
                         std::abs(*best->facts.aperture - aperture) > 0.05 * aperture;
  return is_better ? *best : declared;
}

}  // namespace omnimapper::check
