#pragma once

#include <omnimapper/mapper/PluginRegistry.h>

#include <string>
#include <vector>

#include "RunState.h"
#include "Schedule.h"
#include "back_end/Estimator.h"
#include "back_end/JobQueue.h"

namespace omnimapper::mapper {

/// Applies the batches of measurement plugins: their own at once, those of their jobs when they are due.
class BatchApplier {
 public:
  /// The caller owns all arguments.
  BatchApplier(std::vector<Named<MeasurementPlugin>>& plugins, RunState& state, Estimator& estimator,
               base::WorkerPool& pool, Schedule& schedule, std::size_t job_delay)
      : plugins_(plugins), state_(state), estimator_(estimator), schedule_(schedule), jobs_(pool, job_delay) {}

  /// Applies a batch and passes the final ids to its plugin. Throws Error(internal) if the batch does not fit.
  void apply(const Batch& batch, const BatchOrigin& origin, MeasurementPlugin& plugin);
  /// Collects the follow-ups of each plugin after key frame `id`: applies their batches now and queues their jobs.
  void collectFollowUps(base::KeyFrameId id);
  /// Which jobs to apply: those that are due now, or all.
  enum class Which { due, all };
  /// Applies the batches of those jobs. A batch that no longer fits is dropped, and the decision log gives the reason.
  void applyJobs(Which which);
  /// Number of jobs whose batches are not applied yet.
  std::size_t jobs() const { return jobs_.size(); }

 private:
  MeasurementPlugin& pluginOf(const std::string& section) const;

  std::vector<Named<MeasurementPlugin>>& plugins_;
  RunState& state_;
  Estimator& estimator_;
  Schedule& schedule_;
  JobQueue jobs_;
};

}  // namespace omnimapper::mapper
