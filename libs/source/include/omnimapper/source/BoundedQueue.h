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

/// Limits of a queue. An item larger than `bytes` is accepted only while the queue is empty.
struct QueueLimits {
  std::size_t count;  ///< at least 1
  std::size_t bytes;
};

/// A queue between two threads: push() waits while it is full, pop() while it is empty. A waiting producer is woken
/// only when the queue is half empty, because waking a thread for each item can cost more than the item itself.
template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(QueueLimits limits) : limits_(limits) {}

  /// Waits for room, then appends the item, whose size is `bytes`. If the queue is closed, discards the item and
  /// returns false.
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

  /// Waits for an item and returns the oldest one; none if the queue is closed. While pop() waits, it calls `stop`,
  /// unless empty, ten times a second, and returns none as soon as `stop` returns true.
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

  /// Ends all waiting, now and later. Items that are still in the queue stay there until it is destroyed.
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
  std::size_t bytes_ = 0;  // of all items
  bool closed_ = false;
};

}  // namespace omnimapper::source
