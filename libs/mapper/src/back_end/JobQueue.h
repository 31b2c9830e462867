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

/// The jobs of the plugins, in order. Each runs in the pool on a snapshot taken at its key frame. Its batch is taken a
/// fixed number of key frames later, in the order of the jobs, so that the result does not depend on the workers.
class JobQueue {
 public:
  JobQueue(base::WorkerPool& pool, std::size_t delay) : pool_(pool), delay_(delay) {}

  /// `now` is the number of key frames so far. The snapshot is kept until the job is taken.
  void add(std::size_t now, const BatchOrigin& origin, base::KeyFrameId frame, Job job,
           std::shared_ptr<const Snapshot> snapshot);

  struct Done {
    BatchOrigin origin;
    base::KeyFrameId frame;  ///< after which the plugin created the job
    std::string name;
    Batch batch;
  };
  /// Takes the oldest job if it is due at `now` key frames, or in any case if `all` is set, and waits until it is done.
  /// Throws whatever the job threw.
  std::optional<Done> take(std::size_t now, bool all);
  /// Whether the oldest job is due at `now` key frames (isDue) and whether its worker has finished it (isDone); false
  /// if there are no jobs.
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
