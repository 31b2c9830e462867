#include "GlobalLoopSearch.h"

#include <omnimapper/geometry/SymmetricEigen.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "GlobalMatcher.h"
#include "RevisitEvidence.h"
#include "ScanFactor.h"

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

GlobalLoopSearch::GlobalLoopSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
                                   std::shared_ptr<const matching::ScanMatcher> matcher,
                                   std::shared_ptr<const ScanDatabase> places, std::string label,
                                   std::vector<LoopSearch::KeyScan> newest, std::vector<LoopSearch::KeyScan> earlier,
                                   bool on_new_ground)
    : options_(options),
      context_(context),
      matcher_(std::move(matcher)),
      places_(std::move(places)),
      label_(std::move(label)),
      newest_(std::move(newest)),
      earlier_(std::move(earlier)),
      on_new_ground_(on_new_ground) {}

mapper::Batch GlobalLoopSearch::operator()(const mapper::State& state) const {
  const auto& frame = state.map.keyFrame(newest_.back().frame);
  mapper::Batch batch;
  mapper::Decision decision(frame, context_.section, "global loop search");
  const auto estimate = judged(state, decision);
  if (!estimate || !estimate->is_lost) return batch;
  const GlobalMatcher matcher(options_, *matcher_, *places_, label_, newest_);
  const auto found = matcher.find(state, decision);
  if (!found || (!found->is_distinct && !matcher.fitsAlongTravel(*found, state, decision))) {
    decision.accepted = false;
    batch.log(std::move(decision));
    return batch;
  }
  const auto& place = state.map.keyFrame(found->place.key_scan.frame);
  const auto apart =
      distanceBetween(found->match.reference_from_scan, planar(frame.map_from_base - place.map_from_base));
  decision.numbers.emplace_back("distance from the estimate [m]", apart.metres);
  decision.numbers.emplace_back("rotation from the estimate [deg]",
                                apart.radians / base::option_text::kRadiansPerDegree);
  constexpr double kNear = 0.3, kNearTurn = 0.2;  // [m] [rad] beyond the uncertainty of the estimate
  if (estimate->uncertainty <= options_.max_window && apart.within(estimate->uncertainty + kNear, kNearTurn)) {
    decision.accepted = false;
    decision.reason = "the match is near the estimate: left to the local search";
    batch.log(std::move(decision));
    return batch;
  }
  decision.kind = "loop closure";
  decision.is_loop_closure = true;
  auto closure = scanFactor(options_, context_, place.pose, frame.pose, found->match);
  closure.loss = graph::Loss::cauchy(options_.loss_scale);
  closure.tags.note = kGlobalClosure;
  batch.addHypothesis(std::move(closure), std::move(decision));
  return batch;
}

std::optional<GlobalLoopSearch::Estimate> GlobalLoopSearch::judged(const mapper::State& state,
                                                                   mapper::Decision& decision) const {
  constexpr double kSigmas = 3;
  constexpr std::size_t kAround = 12;
  constexpr double kFits = 0.3;  // share of a scan that fits the map
  const TPose2D map_from_base = planar(state.map.keyFrame(newest_.back().frame).map_from_base);
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < earlier_.size(); ++i) {
    const TPose2D place = planar(state.map.keyFrame(earlier_[i].frame).map_from_base);
    near.emplace_back(distanceBetween(place, map_from_base).ofViews(), i);
  }
  const std::size_t around = std::min(kAround, near.size());
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(around), near.end());
  near.resize(around);
  if (near.empty()) return std::nullopt;
  const auto& nearest = earlier_[near.front().second];
  const auto covariance = state.covarianceBetween(nearest.frame, newest_.back().frame);
  if (!covariance) return std::nullopt;
  const Eigen::Matrix2d position = covariance->topLeftCorner<2, 2>();
  const double uncertainty = kSigmas * std::sqrt(geometry::eigenvaluesOf<2>(position)[1]);
  decision.numbers.emplace_back("may be off by [m]", uncertainty);
  if (uncertainty > options_.max_window) return Estimate{uncertainty, true};
  const TPose2D place = planar(state.map.keyFrame(nearest.frame).map_from_base);
  if (distanceBetween(place, map_from_base).metres > options_.radius + uncertainty)
    return Estimate{uncertainty, on_new_ground_};
  std::vector<LoopSearch::KeyScan> key_scans;
  for (const auto& one : near) key_scans.push_back(earlier_[one.second]);
  const double fits =
      shareOnWalls(localMap(key_scans, newest_.back().frame, state).points, newest_.back().scan->points);
  decision.numbers.emplace_back("share of the scan that fits the map there [1]", fits);
  return Estimate{uncertainty, fits < kFits};
}

std::shared_ptr<const ScanDatabase> placesToLoopTo(const map::Map& map, const std::string& label,
                                                   const std::vector<LoopSearch::KeyScan>& earlier,
                                                   std::shared_ptr<const matching::ScanMatcher> matcher) {
  // The search is coarse, because the fine matcher follows, and limited, because on new ground nothing fits and an
  // unlimited search would take very long.
  matching::RelocalizerOptions options;
  options.cell = 0.2;
  options.sigma = 0.2;
  options.spacing = 0.3;
  options.max_blocks = 100'000;
  const std::map<std::string, std::vector<LoopSearch::KeyScan>> key_scans{{label, earlier}};
  return std::make_shared<const ScanDatabase>(map, key_scans, std::move(matcher), options);
}

}  // namespace omnimapper::plugins
