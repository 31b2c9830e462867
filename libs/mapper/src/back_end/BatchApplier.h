#pragma once

#include <omnimapper/mapper/PluginRegistry.h>

#include <string>
#include <vector>

#include "back_end/Estimator.h"
#include "back_end/JobQueue.h"

namespace omnimapper::mapper {

/// Applies what measurement plugins return: batches at once, those of their jobs when they are due.
class BatchApplier {
 public:
  /// All of them stay the caller's.
  BatchApplier(std::vector<Named<MeasurementPlugin>>& plugins, map::Map& map, graph::Graph& graph, Estimator& estimator,
               DecisionLog& decisions, base::WorkerPool& pool, std::size_t job_delay)
      : plugins_(plugins),
        map_(map),
        graph_(graph),
        estimator_(estimator),
        decisions_(decisions),
        jobs_(pool, job_delay) {}

  /// Applies a batch and tells its plugin the final ids. Throws Error(internal) if it does not fit.
  void apply(const Batch& batch, const BatchOrigin& origin, MeasurementPlugin& plugin);
  /// What each plugin wants after key frame `id`: its batch now, its jobs into the queue.
  void collectFollowUps(base::KeyFrameId id, const View& view, double& plugin_seconds);
  /// The batches of the jobs that are due, or of all. Of what does not fit any more a word is left in the log.
  /// `waited` grows by the seconds that this thread waited for them.
  void applyJobs(bool all, double& waited);
  /// Jobs whose batches are not applied yet.
  std::size_t jobs() const { return jobs_.size(); }

 private:
  MeasurementPlugin& pluginOf(const std::string& section) const;

  std::vector<Named<MeasurementPlugin>>& plugins_;
  map::Map& map_;
  graph::Graph& graph_;
  Estimator& estimator_;
  DecisionLog& decisions_;
  JobQueue jobs_;
};

}  // namespace omnimapper::mapper
