#include "back_end/JobQueue.h"

#include <chrono>
#include <utility>

namespace omnimapper::mapper {

void JobQueue::add(std::size_t now, const BatchOrigin& origin, base::KeyFrameId frame, Job job,
                   std::shared_ptr<const Snapshot> snapshot) {
  // The task does not own the snapshot: the last owner must release it in the thread that changes map and graph.
  auto batch = pool_.submit<Batch>([work = std::move(job.work), seen = snapshot.get()] { return work(seen->state()); });
  waiting_.push_back({now + delay_, origin, frame, std::move(job.name), std::move(snapshot), std::move(batch)});
}

bool JobQueue::isDone() const {
  return !waiting_.empty() && waiting_.front().batch.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::optional<JobQueue::Done> JobQueue::take(std::size_t now, bool all) {
  if (waiting_.empty() || (!all && !isDue(now))) return std::nullopt;
  Waiting& first = waiting_.front();
  first.batch.wait();
  Waiting taken = std::move(first);
  waiting_.pop_front();
  return Done{taken.origin, taken.frame, std::move(taken.name), taken.batch.get()};
}

}  // namespace omnimapper::mapper
