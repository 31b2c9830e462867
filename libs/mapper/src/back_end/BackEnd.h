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
#include "back_end/MapEvidence.h"
#include "back_end/PoseChain.h"
#include "back_end/SlidingWindow.h"

namespace omnimapper::mapper {

/// Builds the map from bundles of observations (thesis 5.2.3, 5.3.3): each becomes a key frame, the plugins measure
/// there, and the graph is solved from time to time. During a run only the classes of the back end change map and
/// graph.
class BackEnd {
 public:
  /// The caller owns all arguments.
  BackEnd(const EngineSettings& settings, PluginSet& plugins, base::WorkerPool& pool, Schedule& schedule,
          RunState& state);

  /// Begins a session in the current map. Without `start` it begins at the origin, or where absolute measurements place
  /// it.
  void beginSession(const map::Session& session, const std::optional<SessionStart>& start);
  /// Continues a saved map: the map counts as solved, and the plugins restore their saved data.
  void resume();
  /// Holds the current map fixed: later key frames are only localized in it, and about `key_frames` of them are kept
  /// free.
  void holdMap(int key_frames);

  /// Whether the bundle became or joined a key frame. False if its stamp is only a dependent frame, or if no pose
  /// source links it to the others; the latter is counted.
  bool process(FrameBundle& bundle);
  /// Shows the bundle's watched observations to the plugins that watch them, and returns their new observations.
  std::vector<Arrival> watch(const FrameBundle& bundle);
  /// In a run that localizes, takes key frames before `stamp` out of the window; in other runs does nothing.
  void retireBefore(base::Stamp stamp);

  /// Whether there are jobs whose batches are not applied yet.
  bool hasJobs() const { return applier_.jobs() > 0; }
  /// Waits for all remaining jobs and applies their batches in order.
  void applyAllJobs();
  /// Solves with the final options.
  void solveFinally() { solve(&Estimator::solveFinally); }
  /// Applies the edits that plugins make at the end of the log (MeasurementPlugin::atEnd()). Afterwards `shared` has
  /// the results that they share with outputs.
  void conclude(SharedResults& shared);
  /// The evidence for and against the map, of which judge() makes the verdict.
  MapEvidence& evidence() { return evidence_; }
  /// Lets a plugin restore its saved data, and what it needs of the map.
  void restore(const std::string& section, MeasurementPlugin& plugin);
  /// Must be called after plugins were added or removed, while there are no jobs.
  void pluginsChanged();
  /// Reads the layers that were kept as bytes with these readers. One that cannot be read stays as it is, with a
  /// warning.
  void readLayersAgain(const map::LayerRegistry& readers);
  /// Puts the states that the plugins save for a later session into the layers of the map.
  void savePlugins();

  /// `stop` is called while a solve runs; if it returns true, the solve ends with its best values so far.
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
  void solve(void (Estimator::*how)());
  bool isConfirmed() const;
  void addEstimate(base::KeyFrameId id);

  const EngineSettings& settings_;
  PluginSet& plugins_;
  RunState& state_;
  std::set<std::string> absolute_;  // sections of the plugins that give absolute poses
  PoseChain chain_;
  Estimator estimator_;
  std::optional<SlidingWindow> window_;  // only in a run that localizes
  BatchApplier applier_;
  KeptObservations kept_;
  MapEvidence evidence_;
};

}  // namespace omnimapper::mapper
