#include "SweepFit.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/matching/PointToLineMatcher.h>
#include <omnimapper/matching/ScanInBase.h>
#include <omnimapper/perception/LaserPointsExtractor.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "Quantile.h"

namespace omnimapper::check {

namespace {

constexpr std::size_t kMostTurning = 48, kFewestTurning = 10;
constexpr double kTurnsBy = 0.05;  // [rad] of a pair
constexpr double kFarError = 0.1;  // [m] of a point that is not simply on another wall, [rad] of a turn

using Cloud = std::shared_ptr<const mrpt::obs::CObservationPointCloud>;

Cloud pointsOf(const mrpt::obs::CObservation2DRangeScan& scan) {
  static const perception::LaserPointsExtractor extractor{perception::LaserPointsOptions()};
  return std::dynamic_pointer_cast<const mrpt::obs::CObservationPointCloud>(extractor.extract(scan));
}

// A scan with the velocity of the base while it was taken.
struct MovingScan {
  ScanPtr scan;
  Cloud cloud;
  mrpt::math::TPose2D velocity;  // per second

  matching::ScanWithNormals with(double sweep) const {
    if (sweep == 0) return matching::scanInBase(*cloud);
    const mrpt::math::TPose2D motion(sweep * velocity.x, sweep * velocity.y, sweep * velocity.phi);
    return matching::scanInBaseWithThings(*cloud, {scan->aperture, scan->rightToLeft, motion});
  }
};

struct TurningPair {
  MovingScan begin, end;
  mrpt::math::TPose2D by_scans;
  std::optional<mrpt::poses::CPose2D> by_odometry;
};

class SweepComparison {
 public:
  explicit SweepComparison(std::vector<TurningPair> pairs) : pairs_(std::move(pairs)) {}

  // Minus twice the logarithm of the likelihood of a sweep, but for a constant, by the walls and by the odometry.
  struct Cost {
    double walls = 0, odometry = 0;
    double sum() const { return walls + odometry; }
  };

  Cost cost(double sweep) const {
    Cost cost;
    std::vector<std::pair<double, const TurningPair*>> turns;
    for (const auto& pair : pairs_) {
      const auto reference = matcher_.prepare(pair.begin.with(sweep));
      const auto match = matcher_.match(*reference, pair.end.with(sweep), pair.by_scans);
      const double error = std::min(match.wall_distance, kFarError);
      const double squared = match.overlap * error * error + (1 - match.overlap) * kFarError * kFarError;
      // Each pair has a variance of its own, because some places are full of things that are no walls.
      cost.walls += kScansPerPair * std::log(squared + kLeastWall * kLeastWall);
      if (pair.by_odometry) turns.emplace_back(match.reference_from_scan.phi, &pair);
    }
    if (turns.size() >= kFewestTurning) cost.odometry = costOfTurns(turns);
    return cost;
  }

 private:
  static constexpr double kScansPerPair = 2;  // that contribute to the distance between their walls
  static constexpr double kLeastWall = 0.002, kLeastTurnError = 0.001;  // [m] [rad] that no sensor goes below

  // Wheels have errors of their own: they turn by too much or too little, and to one side as they drive on or in time.
  // What these explain is no sweep, whose error grows with the turn and its rate.
  static double costOfTurns(const std::vector<std::pair<double, const TurningPair*>>& turns) {
    const auto rowOf = [](const TurningPair& pair) {
      return Eigen::Vector3d(pair.by_odometry->phi(), pair.by_odometry->x(), 1);
    };
    Eigen::Matrix3d normal = Eigen::Vector3d(1e-6, 1e-3, 1e-3).asDiagonal();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const auto& [by_scans, pair] : turns) {
      normal += rowOf(*pair) * rowOf(*pair).transpose();
      right += rowOf(*pair) * by_scans;
    }
    const Eigen::Vector3d wheels = normal.ldlt().solve(right);
    double squared = 0;
    for (const auto& [by_scans, pair] : turns)
      squared += mrpt::square(std::min(kFarError, std::abs(by_scans - rowOf(*pair).dot(wheels))));
    const double n = static_cast<double>(turns.size());
    return n * std::log(squared / n + kLeastTurnError * kLeastTurnError);
  }

  static matching::ScanMatcherOptions wideOptions() {
    matching::ScanMatcherOptions options;
    options.max_distance = 1.0;
    return options;
  }

  std::vector<TurningPair> pairs_;
  matching::PointToLineMatcher matcher_{wideOptions()};
};

std::optional<MovingScan> moving(const ScanPtr& scan, const ScanPtr& after) {
  constexpr double kLongest = 0.21;  // [s] in which the velocity hardly changes
  if (!scan || !after) return std::nullopt;
  const double seconds = base::secondsBetween(scan->timestamp, after->timestamp);
  if (!(seconds > 0) || seconds > kLongest) return std::nullopt;
  const matching::PointToLineMatcher matcher({});
  MovingScan found{scan, pointsOf(*scan), {}};
  const auto reference = matcher.prepare(matching::scanInBase(*found.cloud));
  const auto match = matcher.match(*reference, matching::scanInBase(*pointsOf(*after)), mrpt::math::TPose2D(0, 0, 0));
  if (match.overlap < 0.5) return std::nullopt;
  const auto& motion = match.reference_from_scan;
  found.velocity = {motion.x / seconds, motion.y / seconds, motion.phi / seconds};
  return found;
}

std::vector<std::size_t> byTurn(const std::vector<MatchedMotion>& motions) {
  std::vector<std::size_t> order(motions.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(motions[a].by_scans.phi()) > std::abs(motions[b].by_scans.phi());
  });
  return order;
}

// The pairs between whose scans the turn rate changed most, and of the others those that turned most.
std::vector<TurningPair> turningPairs(const std::vector<ScanPair>& pairs, const std::vector<MatchedMotion>& motions) {
  constexpr std::size_t kMostCandidates = 120, kMostChanging = 36;
  std::vector<TurningPair> turning;
  for (const auto i : byTurn(motions)) {
    const auto& motion = motions[i];
    if (turning.size() >= kMostCandidates || std::abs(motion.by_scans.phi()) < kTurnsBy) break;
    const auto pair = std::find_if(pairs.begin(), pairs.end(),
                                   [&](const ScanPair& one) { return one.begin->timestamp == motion.begin; });
    if (pair == pairs.end()) continue;
    auto begin = moving(pair->begin, pair->after_begin), end = moving(pair->end, pair->after_end);
    if (!begin || !end) continue;
    turning.push_back({*begin, *end, motion.by_scans.asTPose(), std::nullopt});
    turning.back().by_odometry = motion.by_odometry;
  }
  const auto change = [](const TurningPair& pair) { return std::abs(pair.begin.velocity.phi - pair.end.velocity.phi); };
  std::vector<std::size_t> order(turning.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return change(turning[a]) > change(turning[b]); });
  order.resize(std::min(order.size(), kMostChanging));
  std::vector<TurningPair> chosen;
  for (const auto i : order) chosen.push_back(turning[i]);
  for (std::size_t i = 0; i < turning.size() && chosen.size() < kMostTurning; ++i) {
    if (std::find(order.begin(), order.end(), i) == order.end()) chosen.push_back(turning[i]);
  }
  return chosen;
}

double periodOf(const std::vector<ScanPair>& all) {
  std::vector<double> periods;
  for (const auto& pair : all) {
    if (pair.after_begin) periods.push_back(base::secondsBetween(pair.begin->timestamp, pair.after_begin->timestamp));
  }
  return periods.empty() ? 0 : quantile(periods, 0.5);
}

}  // namespace

bool SweepFacts::isWrong() const {
  constexpr double kLeast = 0.004, kSigmas = 5;  // [s]
  constexpr double kSurely = 20;                 // as for clocks
  // No laser has a negative sweep.
  return advantage > kSurely && std::abs(std::max(0.0, sweep) - declared) > std::max(kLeast, kSigmas * sigma);
}

bool SweepFacts::isInstant() const {
  constexpr double kLeast = 0.004, kSigmas = 3;  // [s]
  return sweep < std::max(kLeast, kSigmas * sigma);
}

std::optional<SweepFacts> fitSweep(const std::vector<ScanPair>& pairs, const std::vector<MatchedMotion>& motions,
                                   double declared) {
  constexpr double kSteps = 8;           // from 0 to the period of the scans
  constexpr double kBeyond = 1.1;        // of the period
  constexpr double kLongestSweep = 0.3;  // [s]
  auto turning = turningPairs(pairs, motions);
  if (turning.size() < kFewestTurning) return std::nullopt;
  const double longest = std::min(kLongestSweep, kBeyond * periodOf(pairs));
  if (longest <= 0) return std::nullopt;
  const SweepComparison comparison(std::move(turning));
  // Negative sweeps, which no laser has, take part so that 0 is not at the end of what is compared.
  double step = longest / kSteps, best = 0, least = std::numeric_limits<double>::infinity();
  for (double sweep = -2 * step; sweep < longest + 0.5 * step; sweep += step) {
    const double cost = comparison.cost(sweep).sum();
    if (cost < least) {
      least = cost;
      best = sweep;
    }
  }
  // The parabola through three sweeps, first wide and then narrow.
  SweepFacts fit;
  fit.declared = declared;
  fit.sweep = best;
  for (const double reach : {step, 0.5 * step}) {
    const double a = comparison.cost(fit.sweep - reach).sum(), b = comparison.cost(fit.sweep).sum(),
                 c = comparison.cost(fit.sweep + reach).sum();
    const double bend = a - 2 * b + c;
    if (!(bend > 0)) return std::nullopt;
    fit.sweep += std::clamp(0.5 * (a - c) / bend, -1.0, 1.0) * reach;
    if (reach == step) fit.sigma = reach * std::sqrt(2 / bend);  // a narrow parabola follows the noise
  }
  const auto with = comparison.cost(fit.sweep), without = comparison.cost(declared);
  constexpr double kLeastByWalls = 4;  // the wheels alone are no proof
  fit.advantage = without.walls - with.walls > kLeastByWalls ? without.sum() - with.sum() : 0;
  return fit;
}

}  // namespace omnimapper::check
