#pragma once

#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/plugin/Job.h>

#include <cstddef>
#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <string>

namespace omnimapper::mapper {

/// Jobs that plugins asked for, in order. Each runs in the pool on the state of its key frame; its batch is taken so
/// many key frames later, in the order the jobs were given, so that what comes out does not depend on the workers.
class JobQueue {
 public:
  JobQueue(base::WorkerPool& pool, std::size_t delay) : pool_(pool), delay_(delay) {}

  /// `now`: the number of key frames so far. The snapshot is kept until the job is taken.
  void add(std::size_t now, const BatchOrigin& origin, base::KeyFrameId frame, Job job,
           std::shared_ptr<const Snapshot> snapshot);

  struct Done {
    BatchOrigin origin;
    base::KeyFrameId frame;  ///< that asked for it
    std::string name;
    Batch batch;
  };
  /// The oldest job, if it is due at `now` key frames, or in any case with `all`; waits for it to be done. Throws what
  /// the job threw.
  std::optional<Done> take(std::size_t now, bool all);
  /// Whether the oldest job is due at `now` key frames, and whether its worker has done it; false without jobs.
  bool isDue(std::size_t now) const { return !waiting_.empty() && waiting_.front().due <= now; }
  bool isDone() const;
  std::size_t size() const { return waiting_.size(); }

 private:
  struct Waiting {
    std::size_t due;
    BatchOrigin origin;
    base::KeyFrameId frame;
    std::string name;
    std::shared_ptr<const Snapshot> snapshot;
    std::future<Batch> batch;
  };
  base::WorkerPool& pool_;
  std::size_t delay_;
  std::deque<Waiting> waiting_;
};

}  // namespace omnimapper::mapper
