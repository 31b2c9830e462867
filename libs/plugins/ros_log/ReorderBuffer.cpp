#include "ReorderBuffer.h"

namespace omnimapper::ros {

void ReorderBuffer::add(Waiting waiting) {
  bytes_ += waiting.bytes;
  waiting_.push(std::move(waiting));
}

std::optional<Waiting> ReorderBuffer::next() {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 25;
  constexpr std::size_t kMost = 20'000;
  if (waiting_.empty()) return std::nullopt;
  const bool is_full = bytes_ > kMostBytes || waiting_.size() > kMost;
  if (!is_full && waiting_.top().recorded > reached_ - kHeldBack) return std::nullopt;
  Waiting first = waiting_.top();
  waiting_.pop();
  bytes_ -= first.bytes;
  return first;
}

}  // namespace omnimapper::ros
