#include "back_end/Estimator.h"

#include <omnimapper/graph/SolveOne.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>

namespace omnimapper::mapper {

void Estimator::refine(base::KeyFrameId id) {
  map::KeyFrame& frame = state_.map.key_frames.edit(id);
  graph::solveOne(state_.graph, frame.pose);
  frame.map_from_base = poseOf(state_.graph, frame.pose);
}

void Estimator::applied(const Batch& batch, const AppliedBatch& ids) {
  // Bound of chi-square per row above which a hypothesis contradicts the estimate: 7.8 for three rows, which noise
  // exceeds in one case of twenty.
  constexpr double kContradiction = 2.6;
  hypotheses_.take(batch, ids, state_.graph, state_.decisions);
  for (const auto id : ids.factors) {
    if (!state_.graph.factor(id).tags.hypothesis) continue;
    const auto residual = state_.graph.whitenedResidual(id);
    contradicted_ = contradicted_ || residual.squaredNorm() > kContradiction * static_cast<double>(residual.size());
  }
}

bool Estimator::isDue() const {
  const auto& options = settings_.engine;
  const double since_solve = static_cast<double>(state_.map.key_frames.size() - key_frames_at_solve_);
  // In a window a solve is cheap, and a current pose matters most. A hypothesis that may join the session to the map is
  // urgent, too.
  const bool is_aligned = state_.map.sessions.empty() || state_.map.sessions.back().aligned;
  if (held_ > 0 && hypotheses_.anyFresh()) {
    // The window of a session that is not aligned yet grows, because no key frame leaves it.
    const double own = static_cast<double>(state_.map.key_frames.size() - held_);
    return is_aligned || since_solve >= options.solve_growth * own;
  }
  if (held_ > 0 || (!is_aligned && hypotheses_.anyFresh())) return since_solve >= options.solve_after_closure;
  const double growth = options.solve_growth * static_cast<double>(state_.map.key_frames.size());
  if (!hypotheses_.anyFresh()) return since_solve >= std::max<double>(options.solve_every, growth);
  return since_solve >= std::max<double>(options.solve_after_closure, contradicted_ ? growth / 4 : growth);
}

// By the tree, where it followed the solve.
Uncertainty Estimator::uncertainty(const graph::Minimizer& minimizer) {
  if (&minimizer == &smoother_)
    if (auto marginals = smoother_.marginals(state_.graph)) return {state_.graph, std::move(*marginals)};
  return Uncertainty(state_.graph);
}

void Estimator::follow() {
  // To compare and copy chunks costs more than to eliminate what one key frame adds.
  constexpr std::size_t kEvery = 10;
  if (!settings_.solver.incremental || state_.map.key_frames.size() % kEvery != 0) return;
  smoother_.follow(state_.graph);
}

void Estimator::solveBy(graph::Minimizer& minimizer, graph::SolveOptions options) {
  const StopWatch watch;
  options.stop = stop_;
  const double initial_cost = state_.graph.cost();
  hypotheses_.solve(state_.graph, options, minimizer, state_.map, state_.decisions);
  for (std::size_t i = held_; i < state_.map.key_frames.size(); ++i) {
    auto& frame = state_.map.key_frames.edit(state_.map.key_frames[i].id);
    frame.map_from_base = poseOf(state_.graph, frame.pose);
  }
  state_.uncertainty = uncertainty(minimizer);
  state_.solves.push_back({state_.map.key_frames.size(), state_.graph.factors().size(), initial_cost,
                           state_.graph.cost(), watch.seconds()});
  key_frames_at_solve_ = state_.map.key_frames.size();
  contradicted_ = false;
}

}  // namespace omnimapper::mapper
