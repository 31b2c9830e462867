#include <omnimapper/matching/LikelihoodPyramid.h>
#include <omnimapper/plugins/GlobalLoopSearch.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "GlobalMatcher.h"
#include "ScanFactor.h"

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

GlobalLoopSearch::GlobalLoopSearch(const LoopClosureOptions& options, const mapper::PluginContext& context,
                                   std::shared_ptr<const matching::ScanMatcher> matcher,
                                   std::shared_ptr<const KnownPlaces> places, std::string label,
                                   std::vector<LoopSearch::Sight> newest, std::vector<LoopSearch::Sight> earlier,
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
  mapper::Decision decision;
  decision.stamp = frame.stamp;
  decision.plugin = context_.section;
  decision.kind = "global loop search";
  decision.from = frame.id;
  if (!isLost(state, decision)) return batch;
  const GlobalMatcher matcher(options_, *matcher_, *places_, label_, newest_);
  const auto found = matcher.find(state, decision);
  if (!found || (!found->is_distinct && !matcher.fitsAllTheWay(*found, state, decision))) {
    decision.accepted = false;
    batch.log(std::move(decision));
    return batch;
  }
  const auto& place = state.map.keyFrame(found->place.sight.frame);
  const auto apart =
      distanceBetween(found->match.reference_from_scan, planar(frame.map_from_base - place.map_from_base));
  decision.numbers.emplace_back("from the estimate [m]", apart.metres);
  decision.numbers.emplace_back("from the estimate [deg]", apart.radians / base::option_text::kRadiansPerDegree);
  decision.kind = "loop closure";
  auto closure = scanFactor(options_, context_, place.pose, frame.pose, found->match);
  closure.loss = graph::Loss::cauchy(options_.loss_scale);
  closure.tags.note = kGlobalClosure;
  batch.addHypothesis(std::move(closure), std::move(decision));
  return batch;
}

// Either it may be anywhere, or it is sure to be on ground that was seen before, and what it sees is not there.
bool GlobalLoopSearch::isLost(const mapper::State& state, mapper::Decision& decision) const {
  constexpr double kSigmas = 3;
  constexpr std::size_t kAround = 12;
  constexpr double kFits = 0.5;  // of what is seen
  const TPose2D map_from_base = planar(state.map.keyFrame(newest_.back().frame).map_from_base);
  // One that looks another way has seen little of what is seen here.
  constexpr double kMetresPerRadian = 2;
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < earlier_.size(); ++i) {
    const auto apart = distanceBetween(planar(state.map.keyFrame(earlier_[i].frame).map_from_base), map_from_base);
    near.emplace_back(apart.metres + kMetresPerRadian * apart.radians, i);
  }
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(std::min(kAround, near.size())),
                    near.end());
  near.resize(std::min(kAround, near.size()));
  if (near.empty()) return false;
  const auto covariance = state.covarianceBetween(earlier_[near.front().second].frame, newest_.back().frame);
  if (!covariance) return false;
  const Eigen::Matrix2d position = covariance->topLeftCorner<2, 2>();
  const double doubt =
      kSigmas * std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(position).eigenvalues()[1]);  // [m]
  decision.numbers.emplace_back("may be off by [m]", doubt);
  if (doubt > options_.max_window) return true;
  if (near.front().first > options_.radius + doubt) return on_new_ground_;
  std::vector<LoopSearch::Sight> sights;
  for (const auto& one : near) sights.push_back(earlier_[one.second]);
  const double fits = shareThatFits(sights, state);
  decision.numbers.emplace_back("share that fits the map there [1]", fits);
  return fits < kFits;
}

// Of the newest scan.
double GlobalLoopSearch::shareThatFits(const std::vector<LoopSearch::Sight>& near, const mapper::State& state) const {
  const auto local = localMap(near, newest_.back().frame, state);
  const auto& seen = *newest_.back().scan;
  if (local.points.empty() || seen.points.empty()) return 0;
  matching::LikelihoodOptions grid;
  grid.cell = 0.1;
  grid.sigma = 0.15;
  grid.levels = 1;
  return matching::LikelihoodPyramid(local.points, grid).score(seen.points, TPose2D());
}

std::shared_ptr<const KnownPlaces> placesToLoopTo(map::Map map, const std::string& label,
                                                  const std::vector<LoopSearch::Sight>& earlier,
                                                  std::shared_ptr<const matching::ScanMatcher> matcher) {
  // Coarse, for the fine matcher follows, and bounded, for on new ground nothing fits and there is no end to the
  // search.
  matching::RelocaliserOptions options;
  options.cell = 0.2;
  options.sigma = 0.2;
  options.spacing = 0.3;
  options.max_blocks = 20'000;
  const std::map<std::string, std::vector<LoopSearch::Sight>> sights{{label, earlier}};
  return std::make_shared<const KnownPlaces>(std::move(map), sights, std::move(matcher), options);
}

}  // namespace omnimapper::plugins
