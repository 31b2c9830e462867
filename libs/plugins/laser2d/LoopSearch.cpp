#include "LoopSearch.h"

#include <omnimapper/geometry/SymmetricEigen.h>
#include <omnimapper/matching/CorrelativeSearch.h>

#include <algorithm>
#include <cmath>

#include "ScanFactor.h"
#include "SessionCheck.h"

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

namespace {
constexpr double kReachSigmas = 3;              // standard deviations of the estimate that are searched
constexpr double kAlike = 0.05;                 // difference in overlap below which two matches are equally good
constexpr double kSame = 0.3, kSameTurn = 0.1;  // [m] [rad] within which two matches are one
constexpr std::size_t kMostBlocks = 100'000;    // of a search: about a second in a large window with few features

// Whether `newest` is of a session that is not tied to that of `place`.
bool isUnaligned(base::KeyFrameId place, base::KeyFrameId newest, const map::Map& map) {
  if (map.sessions.empty() || map.sessions.back().aligned) return false;
  return newest.session == map.sessions.back().number && place.session != newest.session;
}
}  // namespace

matching::ScanWithNormals localMap(const std::vector<LoopSearch::KeyScan>& key_scans, base::KeyFrameId centre,
                                   const mapper::State& state) {
  const auto& map_from_centre = state.map.keyFrame(centre).map_from_base;
  matching::ScanWithNormals local;
  for (const auto& key_scan : key_scans) {
    matching::append(*key_scan.scan, planar(state.map.keyFrame(key_scan.frame).map_from_base - map_from_centre), local);
  }
  return local;
}

mapper::Batch LoopSearch::operator()(const mapper::State& state) const {
  std::vector<Attempt> attempts;
  for (const auto& place : places_) {
    if (static_cast<int>(attempts.size()) == options_.candidates) break;
    if (auto attempt = attemptAt(place, state)) attempts.push_back(std::move(*attempt));
  }
  mapper::Batch batch;
  for (auto& attempt : attempts) {
    auto& decision = attempt.decision;
    judgeClosure(optionsFor(attempt), attempt.matches, attempt.guess, decision);
    if (decision.accepted) {
      if (const auto elsewhere = overlapElsewhere(attempts, attempt, state)) {
        decision.accepted = false;
        decision.reason = "ambiguous: the scans fit another place as well or better";
        decision.numbers.emplace_back("overlap elsewhere", *elsewhere);
      }
    }
    if (decision.accepted && !confirmsSession(attempt, state, decision)) decision.accepted = false;
    if (decision.accepted && !confirmsAcrossBreak(attempt, state, decision)) decision.accepted = false;
    if (!decision.accepted) {
      batch.log(std::move(decision));
      continue;
    }
    auto closure = scanFactor(options_, context_, state.map.keyFrame(attempt.place->centre.frame).pose,
                              state.map.keyFrame(newest_.back().frame).pose, attempt.matches.front());
    closure.loss = graph::Loss::cauchy(options_.loss_scale);
    batch.addHypothesis(std::move(closure), std::move(decision));
  }
  return batch;
}

// Across a gap, a match near the estimate has two witnesses, the scans and the wheels: it may overlap less, as where
// people came near meanwhile.
LoopClosureOptions LoopSearch::optionsFor(const Attempt& attempt) const {
  constexpr double kShare = 0.8;  // of the overlap that others must have
  LoopClosureOptions options = options_;
  if (isAcrossBreak(*attempt.place) && isNearEstimate(attempt)) options.min_overlap *= kShare;
  return options;
}

bool LoopSearch::isNearEstimate(const Attempt& attempt) {
  constexpr double kNear = 0.5, kNearTurn = 0.2;  // [m] [rad]
  return !attempt.matches.empty() &&
         distanceBetween(attempt.matches.front().reference_from_scan, attempt.guess).within(kNear, kNearTurn);
}

bool LoopSearch::isAcrossBreak(const Place& place) const {
  return place.centre.frame.session == newest_.back().frame.session && place.centre.travel < broken_;
}

// In a wide window, points lie on walls in more than one place, where corridors look alike. So the beams of the newest
// scans are compared with what was seen around the place: near the estimate most must not contradict it, elsewhere
// none.
bool LoopSearch::confirmsAcrossBreak(const Attempt& attempt, const mapper::State& state,
                                     mapper::Decision& decision) const {
  if (!isAcrossBreak(*attempt.place)) return true;
  const ScanDatabase around(state.map, {{label_, attempt.place->around}}, matcher_);
  if (around.empty()) return true;  // a session that is not aligned: nothing can tell
  const TPose2D map_from_newest = planar(state.map.keyFrame(attempt.place->centre.frame).map_from_base) +
                                  attempt.matches.front().reference_from_scan;
  const auto fit = checkSession(around, label_, newest_, map_from_newest, state);
  decision.numbers.emplace_back("scans that contradict the map", static_cast<double>(fit.contradicting));
  if (fit.confirms(true) || (isNearEstimate(attempt) && fit.fits > 0 && 2 * fit.contradicting < fit.scans)) return true;
  decision.reason = fit.contradicting > 0 ? "beams contradict what was seen there before the gap"
                                          : "beams do not confirm what was seen there before the gap";
  return false;
}

// A closure that ties a session to the saved map decides where all of it lies. Points that lie on walls do not suffice:
// corridors look alike, and beams may pass through the walls of the map.
bool LoopSearch::confirmsSession(const Attempt& attempt, const mapper::State& state, mapper::Decision& decision) const {
  const auto place = attempt.place->centre.frame;
  if (!saved_ || !isUnaligned(place, newest_.back().frame, state.map)) return true;
  const TPose2D map_from_newest =
      planar(state.map.keyFrame(place).map_from_base) + attempt.matches.front().reference_from_scan;
  const auto fit = checkSession(*saved_, label_, newest_, map_from_newest, state);
  decision.numbers.emplace_back("distance travelled along which scans fit [m]", fit.fitting);
  decision.numbers.emplace_back("scans that contradict the map", static_cast<double>(fit.contradicting));
  const auto off = distanceBetween(attempt.matches.front().reference_from_scan, attempt.guess);
  const auto uncertainty = uncertaintyAt(*attempt.place, state);
  constexpr double kNear = 2, kSigmas = 2;  // [m], and standard deviations of the estimate
  const bool agrees = off.metres <= std::min(kNear, kSigmas / kReachSigmas * uncertainty.position) &&
                      off.radians <= kSigmas / kReachSigmas * uncertainty.yaw;
  const bool confirms = fit.confirms(agrees);
  if (!confirms)
    decision.reason = fit.contradicting > 0 ? "other scans of the session contradict the map there"
                                            : "scans from another place must confirm where the session lies";
  return confirms;
}

// Overlap of a match at another place that is equally good and elsewhere in the map; none if there is none. The scans
// that are matched are the same at all places. The relative pose of two places is as uncertain as the map says.
std::optional<double> LoopSearch::overlapElsewhere(const std::vector<Attempt>& attempts, const Attempt& attempt,
                                                   const mapper::State& state) {
  const auto& best = attempt.matches.front();
  const auto here = attempt.place->centre.frame;
  for (const auto& other : attempts) {
    const auto there = other.place->centre.frame;
    if (&other == &attempt || other.matches.empty() || other.matches.front().overlap < best.overlap - kAlike) continue;
    const auto covariance = state.covarianceBetween(here, there);
    if (!covariance) continue;
    const double metres = kSame + kReachSigmas * std::sqrt(std::max((*covariance)(0, 0), (*covariance)(1, 1)));
    const double radians = kSameTurn + kReachSigmas * std::sqrt((*covariance)(5, 5));
    const auto here_from_there =
        planar(state.map.keyFrame(there).map_from_base - state.map.keyFrame(here).map_from_base);
    for (const auto& match : other.matches) {
      if (match.overlap < best.overlap - kAlike) break;
      const auto apart = (here_from_there + match.reference_from_scan) - best.reference_from_scan;
      if (std::hypot(apart.x, apart.y) > metres || std::abs(mrpt::math::wrapToPi(apart.phi)) > radians)
        return match.overlap;
    }
  }
  return std::nullopt;
}

LoopSearch::SearchUncertainty LoopSearch::uncertaintyAt(const Place& place, const mapper::State& state) const {
  const auto covariance = state.covarianceBetween(place.centre.frame, newest_.back().frame);
  if (!covariance) return {options_.max_window, options_.max_window_angle};
  const Eigen::Matrix2d position = covariance->topLeftCorner<2, 2>();
  return {kReachSigmas * std::sqrt(geometry::eigenvaluesOf<2>(position)[1]),
          kReachSigmas * std::sqrt((*covariance)(5, 5))};
}

double LoopSearch::queryTravel(const SearchUncertainty& uncertainty) const {
  return options_.context + uncertainty.position;
}

// Leaves out the scans that are to be matched: they would match themselves at the estimated pose.
matching::ScanWithNormals LoopSearch::localMapOf(const Place& place, const SearchUncertainty& uncertainty,
                                                 const mapper::State& state) const {
  const double reach = 2 * options_.context + uncertainty.position,
               end = std::max(newest_.back().travel - queryTravel(uncertainty), broken_);
  std::vector<KeyScan> key_scans;
  std::copy_if(place.around.begin(), place.around.end(), std::back_inserter(key_scans), [&](const KeyScan& key_scan) {
    const bool is_query = key_scan.frame.session == newest_.back().frame.session && key_scan.travel >= end;
    return !is_query && std::abs(key_scan.travel - place.centre.travel) <= reach;
  });
  return localMap(key_scans, place.centre.frame, state);
}

matching::ScanWithNormals LoopSearch::query(const SearchUncertainty& uncertainty, const mapper::State& state) const {
  std::vector<KeyScan> key_scans;
  std::copy_if(newest_.begin(), newest_.end(), std::back_inserter(key_scans), [&](const KeyScan& key_scan) {
    return newest_.back().travel - key_scan.travel <= queryTravel(uncertainty);
  });
  return localMap(key_scans, newest_.back().frame, state);
}

// Poses at which the fine matcher starts; within its own convergence region only the guess.
std::vector<TPose2D> LoopSearch::starts(const matching::ScanWithNormals& local, const matching::ScanWithNormals& query,
                                        const TPose2D& guess, const SearchUncertainty& uncertainty,
                                        bool is_across_break) const {
  constexpr double kReach = 0.4;       // [m]
  constexpr double kAngleReach = 0.2;  // [rad]
  constexpr double kSpacing = 0.25;    // [m] between the points that are searched with
  if (uncertainty.position < kReach && uncertainty.yaw < kAngleReach) return {guess};
  grid::LikelihoodOptions grid;
  grid.cell = 0.1;
  grid.sigma = 0.1;
  const grid::LikelihoodPyramid pyramid(local.points, grid);
  matching::SearchWindow window;
  window.centre = guess;
  window.half_x = window.half_y = std::min(uncertainty.position, options_.max_window);
  window.half_yaw = std::min(uncertainty.yaw, options_.max_window_angle);
  matching::SearchOptions limits;
  limits.min_score = 0.5;
  limits.min_share_of_best = 0.9;
  limits.max_blocks = kMostBlocks;
  // Across a gap the base may have been carried; most often it was not, and the search may miss the estimate where
  // people hide the walls.
  std::vector<TPose2D> found;
  if (is_across_break) found.push_back(guess);
  for (const auto& result :
       matching::search(pyramid, matching::voxelDownsample(query, kSpacing).points, window, limits)) {
    found.push_back(result.map_from_scan);
  }
  return found;
}

std::optional<LoopSearch::Attempt> LoopSearch::attemptAt(const Place& place, const mapper::State& state) const {
  const auto& frame = state.map.keyFrame(newest_.back().frame);
  const auto& centre = state.map.keyFrame(place.centre.frame);
  const auto guess = planar(frame.map_from_base - centre.map_from_base);
  const SearchUncertainty uncertainty = uncertaintyAt(place, state);
  const double apart = std::hypot(guess.x, guess.y);
  if (apart > options_.radius + uncertainty.position) return std::nullopt;
  // If the uncertainty exceeds the window, a wrong place in the window may fit as well: GlobalRelocalization searches.
  if (isUnaligned(centre.id, frame.id, state.map) && uncertainty.position > options_.max_window) return std::nullopt;
  // A closure that adds no information only makes every solve slower.
  const bool is_known = uncertainty.position < kReachSigmas * options_.known_sigma &&
                        uncertainty.yaw < kReachSigmas * options_.known_angle_sigma;
  if (is_known && !context_.map_is_held) return std::nullopt;

  Attempt attempt{&place, guess, {frame, context_.section, "loop closure"}, {}};
  auto& decision = attempt.decision;
  decision.is_loop_closure = true;
  decision.to = centre.id;
  decision.numbers = {{"may be off by [m]", uncertainty.position},
                      {"may be off by [deg]", uncertainty.yaw / base::option_text::kRadiansPerDegree}};
  constexpr double kSpacing = 0.08;  // [m]
  const auto local = matching::voxelDownsample(localMapOf(place, uncertainty, state), kSpacing / 2),
             query = matching::voxelDownsample(this->query(uncertainty, state), kSpacing);
  const auto reference = matcher_->prepare(local);
  auto& matches = attempt.matches;
  for (const auto& start : starts(local, query, guess, uncertainty, isAcrossBreak(place)))
    matches.push_back(matcher_->match(*reference, query, start));
  std::sort(matches.begin(), matches.end(), [](const auto& a, const auto& b) { return a.overlap > b.overlap; });
  return attempt;
}

// Corridors that look alike and rooms with a symmetry give several equally good matches.
void judgeClosure(const LoopClosureOptions& options, const std::vector<matching::ScanMatch>& matches,
                  const TPose2D& guess, mapper::Decision& decision) {
  if (matches.empty()) {
    decision.reason = "no match in the search window";
    return;
  }
  const auto& best = matches.front();
  const auto correction = best.reference_from_scan - guess;
  decision.numbers.insert(decision.numbers.end(), {{"overlap", best.overlap},
                                                   {"distance from walls [m]", best.wall_distance},
                                                   {"correction [m]", std::hypot(correction.x, correction.y)},
                                                   {"correction [deg]", std::abs(mrpt::math::wrapToPi(correction.phi)) /
                                                                            base::option_text::kRadiansPerDegree}});
  if (best.overlap < options.min_overlap) {
    decision.reason = "too little overlap";
    return;
  }
  for (std::size_t i = 1; i < matches.size() && matches[i].overlap > best.overlap - kAlike; ++i) {
    const auto apart = matches[i].reference_from_scan - best.reference_from_scan;
    if (std::hypot(apart.x, apart.y) < kSame && std::abs(mrpt::math::wrapToPi(apart.phi)) < kSameTurn) continue;
    decision.reason = "ambiguous: the scans fit elsewhere as well";
    decision.numbers.emplace_back("overlap elsewhere", matches[i].overlap);
    return;
  }
  // A match that can slide along a corridor does not determine the position along it.
  const double point_sigma = std::max(options.point_sigma, best.point_sigma);
  const Eigen::Matrix2d position = best.unit_covariance.topLeftCorner<2, 2>();
  const double sigma = point_sigma * std::sqrt(geometry::eigenvaluesOf<2>(position)[1]);
  decision.numbers.emplace_back("uncertainty of the match [m]", sigma);
  if (best.degenerate || sigma > options.max_sigma) {
    decision.reason =
        best.degenerate ? "the walls leave a direction unconstrained" : "the walls constrain the match too weakly";
    return;
  }
  decision.accepted = true;
  decision.reason = "matched";
}

}  // namespace omnimapper::plugins
