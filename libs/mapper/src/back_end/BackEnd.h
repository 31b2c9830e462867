#pragma once

#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/PluginRegistry.h>

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "FrameBundle.h"
#include "RunState.h"
#include "back_end/BatchApplier.h"
#include "back_end/Estimator.h"
#include "back_end/KeptObservations.h"
#include "back_end/PoseChain.h"
#include "back_end/SlidingWindow.h"

namespace omnimapper::mapper {

/// Bundles of observations in, a map out (thesis 5.2.3, 5.3.3): each becomes a key frame, plugins measure there, and
/// the graph is solved from time to time. During a run nothing but the back end's classes changes map and graph.
class BackEnd {
 public:
  /// All of them stay the caller's.
  BackEnd(const EngineSettings& settings, PluginSet& plugins, base::WorkerPool& pool, Schedule& schedule,
          RunState& state);

  /// Begins a session in the map as it stands; without `start` at the origin, or where measurements say.
  void beginSession(const map::Session& session, const std::optional<SessionStart>& start);
  /// Goes on from a saved map: it counts as solved, and plugins find in it what they left there.
  void resume();
  /// The map stands and is held from now on: what follows is only localized in it, and about `key_frames` of that are
  /// kept free.
  void holdMap(int key_frames);

  /// Whether the bundle became or joined a key frame. False where its stamp is a dependent frame alone, and where no
  /// source links it to the others, which is counted.
  bool process(FrameBundle& bundle);
  /// Takes key frames before `stamp` out of the window of a run that localizes; does nothing in others.
  void retireBefore(base::Stamp stamp);

  /// Whether jobs are still to be applied.
  bool hasJobs() const { return applier_.jobs() > 0; }
  /// Waits for the jobs that are left, and applies what they found, in order.
  void applyAllJobs();
  /// Solves to the end.
  void solveFinally() { solve(settings_.solver.final()); }
  /// Finds which way is up.
  void findLevel();
  /// Lets plugins conclude what only the whole log tells.
  void conclude();
  /// Weighs what plugins say for and against the map.
  void judgeMap();
  /// Keeps what plugins leave to a later session.
  void collectSections();

  /// Asked while a solve runs; true ends it with the best so far.
  void setStop(std::function<bool()> stop) { estimator_.setStop(std::move(stop)); }
  PoseChain& chain() { return chain_; }

 private:
  struct Gathered {
    std::vector<Perceived> perceived;
    std::vector<map::CloudPoint> cloud;
  };
  Gathered gather(FrameBundle& bundle, base::KeyFrameId id);
  void measure(base::KeyFrameId id, const std::vector<Perceived>& perceived);
  void commit(base::KeyFrameId id);
  void solve(const graph::SolveOptions& options);
  void addEstimate(base::KeyFrameId id);

  const EngineSettings& settings_;
  PluginSet& plugins_;
  RunState& state_;
  std::set<std::string> absolute_;  // sections of the plugins that say where in the map the base is
  PoseChain chain_;
  Estimator estimator_;
  std::optional<SlidingWindow> window_;  // of a run that localizes
  BatchApplier applier_;
  KeptObservations kept_;
};

}  // namespace omnimapper::mapper
