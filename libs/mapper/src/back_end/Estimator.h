#pragma once

#include <omnimapper/graph/IncrementalSmoother.h>
#include <omnimapper/mapper/EngineOptions.h>

#include <cstddef>
#include <functional>
#include <utility>

#include "RunState.h"
#include "back_end/Hypotheses.h"

namespace omnimapper::mapper {

/// Decides when the graph is solved and updates what depends on it: poses of the key frames, the uncertainty for gates,
/// and the record for the report's curves. Between solves only the newest pose is refined.
class Estimator {
 public:
  /// The caller owns both arguments.
  Estimator(const EngineSettings& settings, RunState& state)
      : settings_(settings), state_(state), hypotheses_(settings.hypotheses.consistency()) {}

  /// Called when the first key frame of a session is in the graph: gates start from its covariance.
  void begin() { state_.uncertainty = Uncertainty(state_.graph); }
  /// Called when a saved map was loaded, which counts as solved.
  void resume() {
    begin();
    key_frames_at_solve_ = state_.map.key_frames.size();
  }
  /// The first `key_frames` of the map are held fixed, and no factor binds them any more (SlidingWindow).
  void hold(std::size_t key_frames) { held_ = key_frames; }
  /// Must be called after each batch that was applied; its decisions are the last of the log.
  void applied(const Batch& batch, const AppliedBatch& ids);
  /// Moves one key frame to the optimum of all factors that bind it, with all other variables held.
  void refine(base::KeyFrameId id);
  /// Whether it is time to solve: after a number of key frames, earlier if hypotheses wait for their verdict, and
  /// earliest if one of them contradicts the estimate. The intervals grow with the map, so that the cost per key frame
  /// does not.
  bool isDue() const;
  /// Must be called for each key frame whose batches are applied and after which nothing is solved: prepares the next
  /// solve.
  void follow();
  /// Tests the hypotheses and solves with those that are consistent.
  void solve() { solveBy(running(), settings_.solver.running()); }
  /// The same with the final options, and as a whole.
  void solveFinally() { solveBy(batch_, settings_.solver.final()); }

  /// `stop` is called while a solve runs; if it returns true, the solve ends with its best values so far.
  void setStop(std::function<bool()> stop) { stop_ = std::move(stop); }

 private:
  graph::Minimizer& running() {
    return settings_.solver.incremental ? static_cast<graph::Minimizer&>(smoother_) : batch_;
  }
  Uncertainty uncertainty(const graph::Minimizer& minimizer);
  void solveBy(graph::Minimizer& minimizer, graph::SolveOptions options);

  const EngineSettings& settings_;
  RunState& state_;
  Hypotheses hypotheses_;
  graph::BatchMinimizer batch_;
  graph::IncrementalSmoother smoother_;
  std::function<bool()> stop_;
  std::size_t key_frames_at_solve_ = 0;
  std::size_t held_ = 0;       // number of key frames that are held
  bool contradicted_ = false;  // a hypothesis since the last solve contradicts the estimate
};

}  // namespace omnimapper::mapper
