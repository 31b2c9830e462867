#pragma once

#include <omnimapper/mapper/PluginRegistry.h>

#include <string>
#include <vector>

#include "RunState.h"
#include "Schedule.h"
#include "back_end/Estimator.h"
#include "back_end/JobQueue.h"

namespace omnimapper::mapper {

/// Applies what measurement plugins return: batches at once, those of their jobs when they are due.
class BatchApplier {
 public:
  /// All of them stay the caller's.
  BatchApplier(std::vector<Named<MeasurementPlugin>>& plugins, RunState& state, Estimator& estimator,
               base::WorkerPool& pool, Schedule& schedule, std::size_t job_delay)
      : plugins_(plugins), state_(state), estimator_(estimator), schedule_(schedule), jobs_(pool, job_delay) {}

  /// Applies a batch and tells its plugin the final ids. Throws Error(internal) if it does not fit.
  void apply(const Batch& batch, const BatchOrigin& origin, MeasurementPlugin& plugin);
  /// What each plugin wants after key frame `id`: its batch now, its jobs into the queue.
  void collectFollowUps(base::KeyFrameId id);
  /// The jobs that are due now, or all that are left.
  enum class Which { due, all };
  /// Applies the batches of those jobs. One that no longer fits is dropped, and the decision log says why.
  void applyJobs(Which which);
  /// Jobs whose batches are not applied yet.
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
