#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

namespace omnimapper::source {

/// What a queue may hold. An item that is larger than all the bytes waits alone.
struct QueueLimits {
  std::size_t count;  ///< at least 1
  std::size_t bytes;
};

/// A queue between two threads: who adds waits while it is full, who takes waits while it is empty. Once full, it is
/// half emptied before the waiting thread is woken: waking it for each item costs more than many an item.
template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(QueueLimits limits) : limits_(limits) {}

  /// Waits for room. False if the queue is closed: the item is gone. `bytes` is what the item counts for.
  bool push(T item, std::size_t bytes) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [&] { return closed_ || hasRoomFor(bytes); });
    if (closed_) return false;
    items_.emplace_back(std::move(item), bytes);
    bytes_ += bytes;
    lock.unlock();
    filled_.notify_one();
    return true;
  }

  /// Waits for an item, the oldest. Nothing if the queue is closed, or if `stop`, which is asked ten times a second
  /// while it waits, says so; an empty `stop` never does.
  std::optional<T> pop(const std::function<bool()>& stop = {}) {
    std::unique_lock lock(mutex_);
    const auto is_ready = [&] { return closed_ || !items_.empty(); };
    while (!filled_.wait_for(lock, std::chrono::milliseconds(100), is_ready)) {
      lock.unlock();
      if (stop && stop()) return std::nullopt;
      lock.lock();
    }
    if (closed_) return std::nullopt;
    std::optional<T> item(std::move(items_.front().first));
    bytes_ -= items_.front().second;
    items_.pop_front();
    const bool has_emptied = items_.size() <= limits_.count / 2 && bytes_ <= limits_.bytes / 2;
    lock.unlock();
    if (has_emptied) room_.notify_one();
    return item;
  }

  /// Ends all waiting, now and later. What is in the queue stays there until the queue is destroyed.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    room_.notify_all();
    filled_.notify_all();
  }

  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return items_.size();
  }

 private:
  bool hasRoomFor(std::size_t bytes) const {
    return items_.empty() || (items_.size() < limits_.count && bytes_ + bytes <= limits_.bytes);
  }

  const QueueLimits limits_;
  mutable std::mutex mutex_;
  std::condition_variable room_, filled_;
  std::deque<std::pair<T, std::size_t>> items_;
  std::size_t bytes_ = 0;  // of the items
  bool closed_ = false;
};

}  // namespace omnimapper::source
