#include <mrpt/poses/CPose2D.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/plugins/MapSearch.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ScanFactor.h"

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

namespace {

constexpr double kDegree = base::option_text::kRadiansPerDegree;
constexpr double kSoughtWay = 4;  // [m] of the way whose scans are sought together

struct Apart {
  double metres, radians;
  bool within(double most_metres, double most_radians) const {
    return metres <= most_metres && radians <= most_radians;
  }
};

Apart between(const TPose2D& a, const TPose2D& b) {
  return {std::hypot(a.x - b.x, a.y - b.y), std::abs(mrpt::math::wrapToPi(a.phi - b.phi))};
}

}  // namespace

MapSearch::MapSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
                     std::shared_ptr<const matching::ScanMatcher> matcher, std::shared_ptr<const KnownPlaces> places,
                     const std::string& label, std::vector<LoopSearch::Sight> newest, double way)
    : options_(options),
      context_(context),
      matcher_(std::move(matcher)),
      places_(std::move(places)),
      label_(label),
      newest_(std::move(newest)),
      way_(way) {}

mapper::Batch MapSearch::operator()(const mapper::State& state) const {
  constexpr std::size_t kAround = 30;                 // key frames of the map that a place is matched with
  constexpr double kAstray = 0.5, kAstrayTurn = 0.2;  // [m] [rad] that the matcher may lead away from the answer
  constexpr double kAgree = 1, kAgreeTurn = 0.25;     // [m] [rad] of an answer and where the session lies
  // What the map has many times, more or less, there is more of where it was not made: such a place is not believed
  // soon.
  constexpr std::size_t kDistinct = 3;
  const auto& frame = state.map.keyFrame(newest_.back().frame);
  mapper::Batch batch;
  mapper::Decision decision;
  decision.stamp = frame.stamp;
  decision.plugin = context_.section;
  decision.kind = "relocalisation";
  decision.from = frame.id;
  if (state.map.sessions.back().joined || !isLost(state, decision)) return batch;
  const auto location = locate(state, decision);
  if (location.answer != matching::Location::Answer::found) {
    batch.log(std::move(decision));
    return batch;
  }
  const TPose2D map_from_base = location.candidates.front().map_from_sensor;
  const auto around = places_->nearest(map_from_base, kAround);
  const auto& place = state.map.keyFrame(around.front().sight.frame);
  decision.to = place.id;
  const TPose2D told = map_from_base - around.front().map_from_base;
  const auto match = verified(around, told, state, decision);
  if (decision.accepted && !between(match.reference_from_scan, told).within(kAstray, kAstrayTurn)) {
    decision.accepted = false;
    decision.reason = "matched elsewhere than it was found";
  }
  if (!decision.accepted) {
    batch.log(std::move(decision));
    return batch;
  }
  if (between(match.reference_from_scan, planar(frame.map_from_base - place.map_from_base))
          .within(kAgree, kAgreeTurn)) {
    const TPose2D map_from_place = around.front().map_from_base;
    const bool is_distinct = location.candidates.size() <= kDistinct;
    if (!is_distinct && !fitsAllTheWay(map_from_place + match.reference_from_scan, state, decision)) {
      decision.accepted = false;
      batch.log(std::move(decision));
      return batch;
    }
    decision.kind = "loop closure";
    auto closure = scanFactor(options_, context_, place.pose, frame.pose, match);
    closure.loss = graph::Loss::cauchy(options_.loss_scale);
    batch.addHypothesis(std::move(closure), std::move(decision));
    return batch;
  }
  auto start = places_->anywhere();
  start.map_from_base = place.map_from_base + mrpt::poses::CPose3D(mrpt::poses::CPose2D(match.reference_from_scan));
  batch.placeSession({frame.id, start});
  decision.reason = "the session is moved there, and waits for another that agrees";
  batch.log(std::move(decision));
  return batch;
}

// Whether the windows around the estimate are too small for what is known of it, or nothing was found in them for long.
bool MapSearch::isLost(const mapper::State& state, mapper::Decision& decision) const {
  constexpr double kSigmas = 3;
  const auto& frame = state.map.keyFrame(newest_.back().frame);
  const auto near = places_->nearest(planar(frame.map_from_base), 1);
  decision.numbers.emplace_back("way of the session [m]", way_);
  const auto covariance = state.covarianceBetween(near.front().sight.frame, frame.id);
  if (!covariance) return true;
  const double doubt = kSigmas * std::sqrt(std::max((*covariance)(0, 0), (*covariance)(1, 1)));  // [m] of either axis
  decision.numbers.emplace_back("may be off by [m]", doubt);
  return doubt > options_.max_window || way_ > options_.lost_way;
}

// Neighbours that see the same from the same place would only cost time.
std::vector<matching::LocalScan> MapSearch::beams(const mapper::State& state) const {
  constexpr double kWay = 0.8, kTurn = 1;  // [m] [rad] from one to the next
  const auto& map_from_newest = state.map.keyFrame(newest_.back().frame).map_from_base;
  constexpr std::size_t kMost = 6;
  std::vector<matching::LocalScan> all;
  const LoopSearch::Sight* last = nullptr;
  TPose2D last_pose;
  for (auto sight = newest_.rbegin(); sight != newest_.rend() && all.size() < kMost; ++sight) {
    if (newest_.back().way - sight->way > kSoughtWay) break;
    const auto& frame = state.map.keyFrame(sight->frame);
    const TPose2D pose = planar(frame.map_from_base - map_from_newest);
    if (last && last->way - sight->way < kWay && between(pose, last_pose).radians < kTurn) continue;
    last = &*sight;
    last_pose = pose;
    auto seen = beamsInBase(frame, label_);
    all.push_back({pose + seen.local_from_sensor, std::move(seen.scan)});
  }
  return all;
}

matching::Location MapSearch::locate(const mapper::State& state, mapper::Decision& decision) const {
  using Answer = matching::Location::Answer;
  matching::Location location;
  const auto scans = beams(state);
  try {
    location = places_->relocaliser().locateTogether(scans);
  } catch (const base::Error& error) {
    if (error.code() != base::ExitCode::out_of_range) throw;
    decision.reason = error.what();  // a map too large for it
    return location;
  }
  const auto& candidates = location.candidates;
  decision.numbers.emplace_back("scans", static_cast<double>(scans.size()));
  decision.numbers.emplace_back("places alike", static_cast<double>(candidates.size()));
  if (!candidates.empty()) {
    decision.numbers.emplace_back("probability", candidates[0].probability);
    decision.numbers.emplace_back("logarithm of a beam's likelihood", candidates[0].log_likelihood);
  }
  if (candidates.size() > 1) decision.numbers.emplace_back("probability of the next", candidates[1].probability);
  if (location.answer == Answer::ambiguous) decision.reason = "ambiguous: it fits as well elsewhere in the map";
  if (location.answer == Answer::none) decision.reason = "nowhere in the map";
  return location;
}

// A corridor that the map has not got looks like one that it has, until its end.
bool MapSearch::fitsAllTheWay(const TPose2D& map_from_newest, const mapper::State& state,
                              mapper::Decision& decision) const {
  constexpr double kSpacing = 1.5;                            // [m] of the way from one scan to the next
  constexpr double kWindow = 0.5, kWindowTurn = 5 * kDegree;  // [m] [rad] of drift on the way
  constexpr double kLeast = -0.8;  // mean logarithm of the beams' likelihoods of a scan that fits
  const auto& base_from_map = state.map.keyFrame(newest_.back().frame).map_from_base;
  const double way = newest_.back().way - newest_.front().way;
  constexpr double kNothing = -10;
  double worst = 0;
  const LoopSearch::Sight* last = nullptr;
  for (auto sight = newest_.rbegin(); sight != newest_.rend(); ++sight) {
    if (last && last->way - sight->way < kSpacing) continue;
    last = &*sight;
    const auto& frame = state.map.keyFrame(sight->frame);
    const auto seen = beamsInBase(frame, label_);
    const TPose2D guess = map_from_newest + planar(frame.map_from_base - base_from_map) + seen.local_from_sensor;
    const auto found =
        places_->relocaliser().locate(seen.scan, matching::SearchWindow{guess, kWindow, kWindow, kWindowTurn});
    const double likelihood = found.candidates.empty() ? kNothing : found.candidates.front().log_likelihood;
    worst = std::min(worst, likelihood);
  }
  decision.numbers.emplace_back("way looked back on [m]", way);
  decision.numbers.emplace_back("logarithm of a beam's likelihood where it fits worst", worst);
  if (worst < kLeast) {
    decision.reason = "what was seen on the way there does not fit";
    return false;
  }
  if (way < options_.join_way) {
    decision.reason = "so much is alike that it waits for a longer way that fits";
    return false;
  }
  return true;
}

matching::ScanMatch MapSearch::verified(const std::vector<KnownPlaces::Place>& around, const TPose2D& place_from_base,
                                        const mapper::State& state, mapper::Decision& decision) const {
  constexpr double kSpacing = 0.08;  // [m]
  std::vector<LoopSearch::Sight> sights, sought;
  for (const auto& place : around) sights.push_back(place.sight);
  std::copy_if(newest_.begin(), newest_.end(), std::back_inserter(sought),
               [&](const LoopSearch::Sight& sight) { return newest_.back().way - sight.way <= kSoughtWay; });
  const auto local = matching::oncePerCell(localMap(sights, sights.front().frame, state), kSpacing / 2),
             query = matching::oncePerCell(localMap(sought, newest_.back().frame, state), kSpacing);
  const auto match = matcher_->match(*matcher_->prepare(local), query, place_from_base);
  judgeClosure(options_, {match}, place_from_base, decision);
  return match;
}

}  // namespace omnimapper::plugins
