#include <omnimapper/graph/SolveOne.h>
#include <omnimapper/mapper/Estimator.h>
#include <omnimapper/mapper/PoseFactors.h>

namespace omnimapper::mapper {

void Estimator::refine(base::KeyFrameId id) {
  map::KeyFrame& frame = map_.key_frames.edit(id);
  graph::solveOne(graph_, frame.pose);
  frame.map_from_base = poseOf(graph_, frame.pose);
}

bool Estimator::isDue() const {
  const std::size_t since_solve = map_.key_frames.size() - key_frames_at_solve_;
  const auto& options = settings_.engine;
  return since_solve >=
         static_cast<std::size_t>(hypotheses_.anyFresh() ? options.solve_after_closure : options.solve_every);
}

void Estimator::solve(graph::SolveOptions options) {
  const StopWatch watch;
  options.stop = stop_;
  const double initial_cost = graph_.cost();
  hypotheses_.solve(graph_, options, map_, decisions_);
  for (std::size_t i = 0; i < map_.key_frames.size(); ++i) {
    auto& frame = map_.key_frames.edit(map_.key_frames[i].id);
    frame.map_from_base = poseOf(graph_, frame.pose);
  }
  uncertainty_ = Uncertainty(graph_);
  solves_.push_back({map_.key_frames.size(), graph_.factors().size(), initial_cost, graph_.cost(), watch.seconds()});
  key_frames_at_solve_ = map_.key_frames.size();
}

}  // namespace omnimapper::mapper
