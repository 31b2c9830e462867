#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace omnimapper::base {

/// Threads that run tasks in the order in which the tasks were submitted. Results are fetched by futures, so they do
/// not depend on the number of threads. The threads start with the first task. Before that, the process can be forked
/// without the risk that one of the threads holds a lock.
class WorkerPool {
 public:
  /// `threads` must be at least 1.
  explicit WorkerPool(int threads) : count_(static_cast<std::size_t>(threads)) {}
  /// Drops tasks that have not started; their futures throw std::future_error.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Submits a task. An exception of the task is rethrown by the future.
  template <class Result>
  std::future<Result> submit(std::function<Result()> task) {
    auto packaged = std::make_shared<std::packaged_task<Result()>>(std::move(task));
    auto result = packaged->get_future();
    push([packaged] { (*packaged)(); });
    return result;
  }

 private:
  void push(std::function<void()> task);
  void work();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> tasks_;
  bool closing_ = false;
  std::size_t count_;
  std::vector<std::thread> threads_;
};

}  // namespace omnimapper::base
