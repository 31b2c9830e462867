#include "GlobalRelocalization.h"

#include <mrpt/poses/CPose2D.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "GlobalMatcher.h"
#include "ScanFactor.h"
#include "SessionCheck.h"

namespace omnimapper::plugins {

GlobalRelocalization::GlobalRelocalization(const LoopClosureOptions& options, const mapper::PluginContext& context,
                                           std::shared_ptr<const matching::ScanMatcher> matcher,
                                           std::shared_ptr<const ScanDatabase> places, const std::string& label,
                                           std::vector<LoopSearch::KeyScan> newest, double travel)
    : options_(options),
      context_(context),
      matcher_(std::move(matcher)),
      places_(std::move(places)),
      label_(label),
      newest_(std::move(newest)),
      travel_(travel) {}

mapper::Batch GlobalRelocalization::operator()(const mapper::State& state) const {
  constexpr double kAgree = 1, kAgreeTurn = 0.25;  // [m] [rad] between an answer and the estimate
  const auto& frame = state.map.keyFrame(newest_.back().frame);
  mapper::Batch batch;
  mapper::Decision decision(frame, context_.section, mapper::kRelocalization);
  if (state.map.sessions.back().aligned || !isLost(state, decision)) return batch;
  const GlobalMatcher matcher(options_, *matcher_, *places_, label_, newest_);
  const auto found = matcher.find(state, decision);
  if (!found) {
    batch.log(std::move(decision));
    return batch;
  }
  const auto& place = state.map.keyFrame(found->place.key_scan.frame);
  const auto& measured = found->match.reference_from_scan;
  if (distanceBetween(measured, planar(frame.map_from_base - place.map_from_base)).within(kAgree, kAgreeTurn)) {
    if (!found->is_distinct && !matcher.fitsAlongTravel(*found, state, decision)) {
      decision.accepted = false;
      batch.log(std::move(decision));
      return batch;
    }
    const auto fit = checkSession(*places_, label_, newest_, found->place.map_from_base + measured, state);
    if (!fit.confirms(false)) {
      decision.accepted = false;
      decision.reason = "other scans of the session contradict the map there, or come from one place only";
      decision.numbers.emplace_back("scans that contradict the map", static_cast<double>(fit.contradicting));
      decision.numbers.emplace_back("scans that fit the map", static_cast<double>(fit.fits));
      decision.numbers.emplace_back("distance along which they fit [m]", fit.fitting);
      decision.numbers.emplace_back("share of their beams that contradict the map", fit.contradicting_beams);
      batch.log(std::move(decision));
      return batch;
    }
    decision.kind = "loop closure";
    decision.is_loop_closure = true;
    auto closure = scanFactor(options_, context_, place.pose, frame.pose, found->match);
    closure.loss = graph::Loss::cauchy(options_.loss_scale);
    batch.addHypothesis(std::move(closure), std::move(decision));
    return batch;
  }
  auto start = places_->anywhere();
  start.map_from_base = place.map_from_base + mrpt::poses::CPose3D(mrpt::poses::CPose2D(measured));
  batch.placeSession({frame.id, start});
  decision.reason = "the session is moved there; another answer must confirm it";
  batch.log(std::move(decision));
  return batch;
}

// Whether the uncertainty of the estimate exceeds the search windows, or the session has travelled lost_travel without
// being aligned.
bool GlobalRelocalization::isLost(const mapper::State& state, mapper::Decision& decision) const {
  constexpr double kSigmas = 3;
  const auto& frame = state.map.keyFrame(newest_.back().frame);
  const auto near = places_->nearest(planar(frame.map_from_base), 1);
  decision.numbers.emplace_back("distance travelled in the session [m]", travel_);
  const auto covariance = state.covarianceBetween(near.front().key_scan.frame, frame.id);
  if (!covariance) return true;
  const double uncertainty =
      kSigmas * std::sqrt(std::max((*covariance)(0, 0), (*covariance)(1, 1)));  // [m] along the less certain axis
  decision.numbers.emplace_back("may be off by [m]", uncertainty);
  return uncertainty > options_.max_window || travel_ > options_.lost_travel;
}

}  // namespace omnimapper::plugins
