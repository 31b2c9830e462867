#include <omnimapper/grid/HitMissGrid.h>
#include <omnimapper/matching/CorrelativeSearch.h>
#include <omnimapper/matching/ScanTracker.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "CombinedMotion.h"

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {

// doc/results/robustness.md has the logs on which these were chosen, and what was tried instead of some of them.
constexpr double kSame = 0.1, kSameTurn = 0.035;    // [m] [rad] within which two matches are the same
constexpr double kBasin = 0.25, kBasinTurn = 0.14;  // [m] [rad] within which a prediction surely leads to a match
constexpr double kIndependent = 30;       // number of beams that count as independent, because neighbours see the same
constexpr double kIndependentInPoor = 3;  // the same where the local map does not explain the scan
constexpr double kUnpredicted = 0.001;    // [1 / (m2 rad)] density of a motion that no source predicts
constexpr double kSomeOverlap = 0.2;      // share of corresponding points below which a match is ignored

constexpr double kSurely = 0.8;  // share of corresponding points from which a single match is accepted as it is
constexpr double kPoor = -0.8;   // mean log-likelihood of the beams below which a better pose is searched
// Mean log-likelihood of beams that all end where the map is unknown.
const double kNothing = std::log(grid::BeamModel().unknown);

double turnOf(const TPose2D& motion) {
  return std::abs(mrpt::math::wrapToPi(motion.phi));
}

bool isBeyond(const TPose2D& motion, double distance, double angle) {
  return std::hypot(motion.x, motion.y) > distance || turnOf(motion) > angle;
}

// Logarithm of the density of a motion, in the mixture of all predictions and of motions that no source predicts.
double logPrior(const TPose2D& motion, const std::vector<MotionPrediction>& predictions) {
  double density = 0;
  bool is_possible = false;
  for (const auto& prediction : predictions) {
    const TPose2D off = motion - prediction.guess.reference_from_scan;
    if (isBeyond(off, prediction.most_position, prediction.most_angle)) continue;
    is_possible = true;
    const double position = std::hypot(off.x, off.y) / prediction.position_sigma,
                 turn = turnOf(off) / prediction.angle_sigma;
    density += std::exp(-0.5 * (position * position + turn * turn)) /
               (prediction.position_sigma * prediction.position_sigma * prediction.angle_sigma);
  }
  return std::log(density + (is_possible ? kUnpredicted : 0));
}

bool isAmong(const std::vector<ScanTracker::Tracked>& found, const TPose2D& motion, double distance, double angle) {
  return std::any_of(found.begin(), found.end(), [&](const ScanTracker::Tracked& one) {
    return !isBeyond(motion - one.match.reference_from_scan, distance, angle);
  });
}

// Whether a match is accepted without a comparison of its beams.
bool isSure(const ScanTracker::Tracked& one, const std::vector<MotionPrediction>& predictions) {
  return one.match.overlap >= kSurely &&
         logPrior(one.match.reference_from_scan, predictions) > std::log(2 * kUnpredicted);
}

ScanTracker::Tracked trackedBy(const ScanMatch& match, std::size_t prediction) {
  ScanTracker::Tracked tracked;
  tracked.match = match;
  tracked.prediction = prediction;
  return tracked;
}

// The beams of a scan, from its laser.
grid::BeamScan beamsOf(const ScanWithNormals& scan, const Eigen::Vector2f& sensor) {
  grid::BeamScan beams;
  beams.hits.reserve(scan.size());
  for (const auto& point : scan.points) beams.hits.push_back(point - sensor);
  return beams;
}

}  // namespace

const base::OptionTable<ScanTrackerOptions>& ScanTrackerOptions::table() {
  using Options = ScanTrackerOptions;
  static const auto table =
      base::OptionTable<Options>()
          .integer("local_scans", &Options::local_scans, base::Range{1, 1000},
                   "Largest number of scans in the local map that a new scan is matched against.")
          .number("local_distance_m", &Options::local_distance, base::Range::positive(),
                  "A scan is added to the local map once it is farther than this from the scan that was added last.")
          .number("local_angle_deg", &Options::local_angle, base::Range{0.1, 180},
                  "A scan is added to the local map once it is rotated by more than this from the scan that was added "
                  "last.")
          .number("min_overlap", &Options::min_overlap, base::Range{0, 1},
                  "A match is accepted only if at least this share of the scan's points have a corresponding point in "
                  "the local map.")
          .number("max_correction_m", &Options::max_correction, base::Range::positive(),
                  "A match whose position is farther from the prediction than this is rejected.")
          .number("max_turn_correction_deg", &Options::max_turn_correction, base::Range{0, 180},
                  "A match whose heading differs from the prediction by more than this is rejected.");
  return table;
}

/// The poses and matches among which one is chosen for a scan.
struct ScanTracker::Candidates {
  struct Weight {
    double fit;    // mean log-likelihood of the beams
    double prior;  // logarithm of the density by the predictions
  };

  const ScanWithNormals& scan;
  grid::BeamScan beams;
  const Eigen::Vector2f& sensor;
  const std::vector<MotionPrediction>& predictions;
  TPose2D local_from_last;
  std::vector<Tracked> found;
  std::vector<Weight> weights;  // of each candidate

  double bestFit() const {
    return std::max_element(weights.begin(), weights.end(),
                            [](const Weight& a, const Weight& b) { return a.fit < b.fit; })
        ->fit;
  }
  /// Unnormalized logarithm of the probability of each candidate. Where none fits (people, glass, grass), a difference
  /// in fit says little. A motion that no source predicted must fit by its beams alone.
  std::vector<double> logarithms() const {
    const double beams = bestFit() < kNothing ? kIndependentInPoor : kIndependent;
    std::vector<double> all;
    for (const auto& weight : weights) {
      const bool is_believed =
          weight.fit >= kPoor || (!predictions.front().is_blind && weight.prior > std::log(2 * kUnpredicted));
      all.push_back(is_believed ? beams * weight.fit + weight.prior : -std::numeric_limits<double>::infinity());
    }
    return all;
  }
};

ScanTracker::ScanTracker(const ScanTrackerOptions& options, std::shared_ptr<const ScanMatcher> matcher)
    : options_(options), matcher_(std::move(matcher)) {}
ScanTracker::~ScanTracker() = default;
ScanTracker::ScanTracker(ScanTracker&&) noexcept = default;
ScanTracker& ScanTracker::operator=(ScanTracker&&) noexcept = default;

void ScanTracker::restart(ScanWithNormals scan, const Eigen::Vector2f& sensor, double seconds) {
  locals_.clear();
  moving_ = {};
  track_from_last_ = {};
  if (scan.things.empty()) scan.things.assign(scan.size(), ScanWithNormals::kNoThing);
  moving_.add({}, sensor, seconds, scan);
  remember(std::move(scan), sensor);
}

std::optional<ScanTracker::Tracked> ScanTracker::track(ScanWithNormals scan, const Eigen::Vector2f& sensor,
                                                       const std::vector<MotionPrediction>& predictions, double seconds,
                                                       const std::optional<MeasuredMotion>& measured) {
  constexpr std::size_t kFew = 10;     // points that stand, too few to match
  constexpr double kMostMoving = 0.5;  // share of the points, beyond which the rest need not match
  if (!reference_ || scan.empty() || predictions.empty()) return std::nullopt;
  if (scan.things.empty()) scan.things.assign(scan.size(), ScanWithNormals::kNoThing);
  const auto& motion = measured ? measured->motion : predictions.front().guess.reference_from_scan;
  auto expected = moving_.expected(track_from_last_ + motion, seconds, scan);
  // Without a measured motion, things help to find it, unless some of them move: they would be wrong together.
  const bool does_anything_move = std::find(expected.moves.begin(), expected.moves.end(), true) != expected.moves.end();
  if (measured || does_anything_move) scan.weights = std::move(expected.weights);
  const auto standing = without(withNeighbours(expected.moves, scan), scan);
  std::optional<Tracked> tracked;
  if (standing.size() >= std::min(kFew, scan.size())) tracked = matched(standing, sensor, predictions);
  const double hidden = 1 - static_cast<double>(standing.size()) / static_cast<double>(scan.size());
  if (!tracked && measured && hidden > kMostMoving) {
    tracked.emplace();
    tracked->match.reference_from_scan = measured->motion;
  }
  if (!tracked) return std::nullopt;
  tracked->covariance = covarianceOf(tracked->match);
  tracked->is_determined = isDetermined(tracked->covariance);
  if (measured) combine(*measured, *tracked);
  const TPose2D track_from_scan = track_from_last_ + tracked->match.reference_from_scan;
  const auto recognized = moving_.add(track_from_scan, sensor, seconds, scan);
  tracked->points = scan.size();
  auto moves = moving_.moving();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (moves[i]) tracked->moving.push_back(i);
    moves[i] = moves[i] || expected.moves[i];
  }
  const TPose2D local_from_scan = track_from_scan - locals_.back().track_from_scan;
  track_from_last_ = track_from_scan;
  const bool is_trimmed = forget(recognized);
  if (isBeyond(local_from_scan, options_.local_distance, options_.local_angle)) {
    remember(without(withNeighbours(moves, scan), scan), sensor);
  } else if (is_trimmed) {
    prepare();
  }
  return tracked;
}

std::optional<BeamFit> ScanTracker::fitAround(const ScanWithNormals& scan, const Eigen::Vector2f& sensor,
                                              const TPose2D& motion, double distance, double angle) {
  if (!reference_ || scan.empty()) return std::nullopt;
  const TPose2D local_from_last = track_from_last_ - locals_.back().track_from_scan;
  return bestFit(beams(), beamsOf(scan, sensor), local_from_last + motion + TPose2D(sensor.x(), sensor.y(), 0),
                 distance, angle);
}

// The match of a scan without what moves, before other sensors count.
std::optional<ScanTracker::Tracked> ScanTracker::matched(const ScanWithNormals& standing, const Eigen::Vector2f& sensor,
                                                         const std::vector<MotionPrediction>& predictions) {
  const TPose2D local_from_last = track_from_last_ - locals_.back().track_from_scan;
  auto found = matchesOf(standing, predictions, local_from_last);
  const bool is_blind = predictions.front().is_blind;
  if (found.size() > 1 || is_blind || !isSure(found.front(), predictions)) {
    Candidates candidates{standing,        beamsOf(standing, sensor), sensor, predictions,
                          local_from_last, std::move(found),          {}};
    weigh(candidates);
    if (is_blind || candidates.bestFit() < kPoor) search(candidates);
    addPredictions(candidates);
    weigh(candidates);
    found = {mostProbable(candidates)};
  }
  if (found.front().match.overlap < options_.min_overlap) return std::nullopt;
  return found.front();
}

// The distinct matches, each with the first prediction that led to it, and the predictions that led to no match.
std::vector<ScanTracker::Tracked> ScanTracker::matchesOf(const ScanWithNormals& scan,
                                                         const std::vector<MotionPrediction>& predictions,
                                                         const TPose2D& local_from_last) const {
  std::vector<Tracked> found;
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    const auto& guess = predictions[i].guess;
    if (isAmong(found, guess.reference_from_scan, kBasin, kBasinTurn)) continue;
    auto match = matcher_->match(*reference_, scan, {local_from_last + guess.reference_from_scan, guess.information});
    match.reference_from_scan = match.reference_from_scan - local_from_last;
    if (match.overlap < kSomeOverlap || isBeyond(match.reference_from_scan - guess.reference_from_scan,
                                                 options_.max_correction, options_.max_turn_correction)) {
      match = {};
      match.reference_from_scan = guess.reference_from_scan;
    }
    if (!isAmong(found, match.reference_from_scan, kSame, kSameTurn)) found.push_back(trackedBy(match, i));
  }
  return found;
}

// Searches all headings, as far around as the best prediction may be off. This is seldom needed.
void ScanTracker::search(Candidates& candidates) {
  constexpr double kSigmas = 3, kLeast = 0.5;  // [1] [m]
  constexpr double kMost = 2, kMostBlind = 3;  // [m]
  constexpr double kSpacing = 0.25;            // [m] between the points that are searched with
  constexpr std::size_t kMostBlocks = 20'000;
  if (!walls_) {
    grid::LikelihoodOptions grid;
    grid.cell = 0.1;
    grid.sigma = 0.1;
    walls_ = std::make_unique<const grid::LikelihoodPyramid>(localMap().points, grid);
  }
  const auto& prediction = candidates.predictions.front();
  SearchWindow window;
  window.centre = candidates.local_from_last + prediction.guess.reference_from_scan;
  window.half_x = window.half_y =
      std::clamp(kSigmas * prediction.position_sigma, kLeast, prediction.is_blind ? kMostBlind : kMost);
  window.half_yaw = M_PI;
  const auto points = voxelDownsample(candidates.scan, kSpacing).points;
  SearchOptions limits;
  limits.max_blocks = kMostBlocks;
  for (const auto& result : matching::search(*walls_, points, window, limits)) {
    auto match = matcher_->match(*reference_, candidates.scan, {result.map_from_scan});
    match.reference_from_scan = match.reference_from_scan - candidates.local_from_last;
    if (match.overlap < kSomeOverlap || isAmong(candidates.found, match.reference_from_scan, kSame, kSameTurn))
      continue;
    candidates.found.push_back(trackedBy(match, 0));
  }
}

// Adds the predictions that no candidate is near to, as candidates themselves.
void ScanTracker::addPredictions(Candidates& candidates) {
  for (std::size_t i = 0; i < candidates.predictions.size(); ++i) {
    Tracked none;
    none.prediction = i;
    none.match.reference_from_scan = candidates.predictions[i].guess.reference_from_scan;
    if (!isAmong(candidates.found, none.match.reference_from_scan, kSame, kSameTurn)) candidates.found.push_back(none);
  }
}

void ScanTracker::weigh(Candidates& candidates) {
  for (std::size_t i = candidates.weights.size(); i < candidates.found.size(); ++i) {
    const TPose2D& motion = candidates.found[i].match.reference_from_scan;
    const TPose2D pose = candidates.local_from_last + motion + TPose2D(candidates.sensor.x(), candidates.sensor.y(), 0);
    const double fit = beams().logLikelihood(candidates.beams, pose);
    candidates.weights.push_back({fit, logPrior(motion, candidates.predictions)});
  }
}

ScanTracker::Tracked ScanTracker::mostProbable(const Candidates& candidates) {
  const auto logarithms = candidates.logarithms();
  const auto best =
      static_cast<std::size_t>(std::max_element(logarithms.begin(), logarithms.end()) - logarithms.begin());
  if (!std::isfinite(logarithms[best])) return {};  // no candidate is plausible
  const auto relative = [&](std::size_t i) { return std::exp(logarithms[i] - logarithms[best]); };
  double sum = 0;
  for (std::size_t i = 0; i < candidates.found.size(); ++i) sum += relative(i);
  Tracked tracked = candidates.found[best];
  for (std::size_t i = 0; i < candidates.found.size(); ++i) {
    const TPose2D off = candidates.found[i].match.reference_from_scan - tracked.match.reference_from_scan;
    const Eigen::Vector3d delta(off.x, off.y, mrpt::math::wrapToPi(off.phi));
    tracked.search_covariance += relative(i) / sum * delta * delta.transpose();
  }
  return tracked;
}

const grid::HitMissGrid& ScanTracker::beams() {
  if (!beams_) {
    grid::BeamModel model;
    model.cell = 0.1;
    model.near_wall = 0.1;
    std::vector<grid::BeamScan> scans;
    scans.reserve(locals_.size());
    std::vector<grid::HitMissGrid::Placed> placed;
    for (const auto& local : locals_) {
      scans.push_back(beamsOf(local.scan, local.sensor));
      const TPose2D newest_from_scan = local.track_from_scan - locals_.back().track_from_scan;
      placed.push_back({newest_from_scan + TPose2D(local.sensor.x(), local.sensor.y(), 0), &scans.back()});
    }
    beams_ = std::make_unique<const grid::HitMissGrid>(placed, model);
  }
  return *beams_;
}

void ScanTracker::remember(ScanWithNormals scan, const Eigen::Vector2f& sensor) {
  locals_.push_back({track_from_last_, std::move(scan), sensor});
  if (locals_.size() > static_cast<std::size_t>(options_.local_scans)) locals_.pop_front();
  prepare();
}

// Removes the traces of things that were recognized as moving. Returns whether there were any.
bool ScanTracker::forget(const std::vector<int>& things) {
  if (things.empty()) return false;
  bool is_trimmed = false;
  for (auto& local : locals_) {
    std::vector<bool> moves(local.scan.size());
    for (std::size_t i = 0; i < moves.size(); ++i) {
      moves[i] = std::find(things.begin(), things.end(), local.scan.things[i]) != things.end();
    }
    if (std::find(moves.begin(), moves.end(), true) == moves.end()) continue;
    local.scan = without(withNeighbours(moves, local.scan), local.scan);
    is_trimmed = true;
  }
  return is_trimmed;
}

void ScanTracker::prepare() {
  reference_ = matcher_->prepare(localMap());
  beams_.reset();
  walls_.reset();
}

ScanWithNormals ScanTracker::localMap() const {
  ScanWithNormals all;
  for (const auto& local : locals_) append(local.scan, local.track_from_scan - locals_.back().track_from_scan, all);
  return all;
}

}  // namespace omnimapper::matching
