#pragma once

#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/State.h>

#include <functional>
#include <string>

namespace omnimapper::mapper {

/// Work that may take longer than the time between two key frames, such as the search for a loop closure. It is a pure
/// function of the state at the key frame that requested it, and runs in the worker pool. Its batch is applied [mapper]
/// job_delay key frames later, or at the end of the log, whatever the number of workers. A batch that can no longer be
/// applied is dropped, and the decision log says so.
struct Job {
  std::string name;  ///< for the decision log: "loop closure of 0:17"
  /// It must read only its argument and its own captures.
  std::function<Batch(const State& state)> work;
};

/// What a plugin requests after a key frame was committed: edits to apply and jobs to run.
struct FollowUp {
  Batch batch;
  std::vector<Job> jobs;
};

}  // namespace omnimapper::mapper
