#pragma once

#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/State.h>

#include <functional>
#include <string>

namespace omnimapper::mapper {

/// Work that may take longer than a key frame, such as the search for a loop closure: a pure function of the state at
/// the key frame that asked for it. It runs in the worker pool; what it returns is applied [mapper] job_delay key
/// frames later, or at the end of the log, whatever the number of workers. A batch that does not fit any more is
/// dropped, with a word in the decision log.
struct Job {
  std::string name;  ///< for the decision log: "loop closure of 0:17"
  /// Must read nothing but its argument and what it holds itself.
  std::function<Batch(const State& state)> work;
};

/// What a plugin wants after a key frame was committed.
struct FollowUp {
  Batch batch;
  std::vector<Job> jobs;
};

}  // namespace omnimapper::mapper
