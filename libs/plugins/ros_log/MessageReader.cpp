#include "MessageReader.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <tuple>

namespace omnimapper::ros {

namespace {
constexpr std::uint64_t kMostHeld = std::uint64_t{1} << 26;  // [bytes] of chunks that overlap in time
}

// std's heaps have their largest element in front.
bool MessageReader::Pending::operator<(const Pending& other) const {
  return std::tie(message.time, place, number) > std::tie(other.message.time, other.place, other.number);
}

MessageReader::MessageReader(const std::vector<std::string>& files, Channels& channels) {
  std::optional<base::Error> refusal;
  for (const auto& file : files) {
    try {
      containers_.push_back(openContainer(file, channels));
      files_.push_back(file);
    } catch (const base::Error& error) {
      if (!refusal) refusal = error;
      unopened_.note(false, error.what());
    }
  }
  if (containers_.empty() && refusal) throw *refusal;
  for (std::size_t file = 0; file < containers_.size(); ++file) {
    const auto& chunks = containers_[file]->chunks();
    for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk) {
      if (chunks[chunk].isTimed()) places_.push_back({file, chunk, chunks[chunk].first_time, chunks[chunk].size});
      total_ += chunks[chunk].isTimed() ? chunks[chunk].size : 0;
    }
  }
  std::stable_sort(places_.begin(), places_.end(),
                   [](const Place& a, const Place& b) { return a.first_time < b.first_time; });
  left_.resize(places_.size());
  sizes_.resize(places_.size());
}

void MessageReader::loadNext() {
  const Place& place = places_[next_place_];
  auto messages = containers_[place.file]->load(place.chunk);
  left_[next_place_] = messages.size();
  done_ += place.size;
  // The messages of a chunk share its buffer, which may be larger than they are, or have one each.
  std::uint64_t of_messages = 0;
  for (const auto& message : messages) of_messages += message.bytes.size();
  sizes_[next_place_] = messages.empty() ? 0 : std::max<std::uint64_t>(of_messages, messages.front().buffer->size());
  held_ += sizes_[next_place_];
  for (std::size_t i = 0; i < messages.size(); ++i) {
    pending_.push_back({std::move(messages[i]), next_place_, i});
    std::push_heap(pending_.begin(), pending_.end());
  }
  ++next_place_;
}

std::optional<Message> MessageReader::next() {
  while (next_place_ < places_.size() &&
         (pending_.empty() || (places_[next_place_].first_time <= pending_.front().message.time && held_ < kMostHeld)))
    loadNext();
  if (pending_.empty()) return std::nullopt;
  std::pop_heap(pending_.begin(), pending_.end());
  Pending first = std::move(pending_.back());
  pending_.pop_back();
  if (--left_[first.place] == 0) held_ -= sizes_[first.place];
  if (first.message.time < latest_) ++unordered_;
  latest_ = std::max(latest_, first.message.time);
  bytes_ += first.message.bytes.size();
  return std::move(first.message);
}

void MessageReader::rewind() {
  next_place_ = 0;
  pending_.clear();
  held_ = done_ = bytes_ = unordered_ = 0;
  latest_ = std::numeric_limits<std::int64_t>::min();
}

double MessageReader::progress() const {
  return total_ == 0 ? 1.0 : static_cast<double>(done_) / static_cast<double>(total_);
}

Damage MessageReader::damage() const {
  for (std::size_t i = 0; i < containers_.size(); ++i)
    if (const auto& damage = containers_[i]->damage(); !damage.what.empty())
      return {damage.is_cut, files_[i] + ": " + damage.what};
  return unopened_;
}

std::vector<std::string> MessageReader::notes() const {
  std::vector<std::string> all;
  for (const auto& container : containers_) all.insert(all.end(), container->notes().begin(), container->notes().end());
  return all;
}

}  // namespace omnimapper::ros
