#include <omnimapper/mapper/PerceptionPool.h>

#include <algorithm>
#include <utility>

namespace omnimapper::mapper {

PerceptionPool::PerceptionPool(std::vector<const Extractor*> extractors, int threads)
    : extractors_(std::move(extractors)) {
  if (extractors_.empty()) return;
  for (int i = 0; i < std::max(1, threads); ++i) threads_.emplace_back([this] { work(); });
}

PerceptionPool::~PerceptionPool() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_all();
  for (auto& thread : threads_) thread.join();
}

bool PerceptionPool::wants(const mrpt::obs::CObservation& raw) const {
  return std::any_of(extractors_.begin(), extractors_.end(), [&](const auto* e) { return e->wants(raw); });
}

std::future<PerceptionPool::Derived> PerceptionPool::submit(mrpt::obs::CObservation::ConstPtr raw) {
  std::packaged_task<Derived()> task([this, raw = std::move(raw)] {
    Derived all;
    for (const auto* extractor : extractors_) {
      if (!extractor->wants(*raw)) continue;
      auto derived = extractor->extract(*raw);
      all.insert(all.end(), derived.begin(), derived.end());
    }
    return all;
  });
  auto result = task.get_future();
  if (threads_.empty()) {
    task();
    return result;
  }
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  wake_.notify_one();
  return result;
}

void PerceptionPool::work() {
  for (;;) {
    std::packaged_task<Derived()> task;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return closing_ || !tasks_.empty(); });
      if (tasks_.empty()) return;
      task = std::move(tasks_.front());
      tasks_.pop_front();
    }
    task();
  }
}

}  // namespace omnimapper::mapper
