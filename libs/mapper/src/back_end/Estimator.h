#pragma once

#include <omnimapper/mapper/EngineOptions.h>

#include <cstddef>
#include <functional>
#include <utility>

#include "RunState.h"
#include "back_end/Hypotheses.h"

namespace omnimapper::mapper {

/// When the graph is solved, and what is kept of it: key frames at their new estimates, the uncertainty for gates, a
/// record for the curves. Between solves the newest pose alone is refined.
class Estimator {
 public:
  /// Both stay the caller's.
  Estimator(const EngineSettings& settings, RunState& state)
      : settings_(settings), state_(state), hypotheses_(settings.hypotheses.consistency()) {}

  /// The first key frame of a session is there: gates start from it.
  void begin() { state_.uncertainty = Uncertainty(state_.graph); }
  /// A saved map is there, which counts as solved.
  void resume() {
    begin();
    key_frames_at_solve_ = state_.map.key_frames.size();
  }
  /// The first so many key frames of the map are held, in a graph that binds them no more (SlidingWindow).
  void hold(std::size_t key_frames) { held_ = key_frames; }
  /// Takes note of a batch that was just applied; its decisions are the last of the log.
  void applied(const Batch& batch, const AppliedBatch& ids);
  /// Moves one key frame to where all factors that bind it want it, all others held.
  void refine(base::KeyFrameId id);
  /// Whether it is time to solve: after so many key frames, sooner where hypotheses wait for their verdict, soonest
  /// where one contradicts the estimate; in a large map later, so that the cost of a key frame does not grow.
  bool isDue() const;
  /// Solves with what is found consistent.
  void solve(graph::SolveOptions options);

  /// Asked while a solve runs; true ends it with the best so far.
  void setStop(std::function<bool()> stop) { stop_ = std::move(stop); }

 private:
  const EngineSettings& settings_;
  RunState& state_;
  Hypotheses hypotheses_;
  std::function<bool()> stop_;
  std::size_t key_frames_at_solve_ = 0;
  std::size_t held_ = 0;       // key frames
  bool contradicted_ = false;  // by a hypothesis since the last solve
};

}  // namespace omnimapper::mapper
