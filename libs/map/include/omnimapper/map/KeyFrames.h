#pragma once

#include <omnimapper/base/IdTable.h>
#include <omnimapper/map/KeyFrame.h>

#include <cstddef>
#include <iterator>
#include <vector>

namespace omnimapper::map {

/// The key frames of a map, sorted by session, then by stamp. Ids are given in the order of insertion, so a key frame
/// that came late has a larger id than its successor. Copies share the key frames that neither copy changed.
class KeyFrames {
 public:
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = KeyFrame;
    using difference_type = std::ptrdiff_t;
    using pointer = const KeyFrame*;
    using reference = const KeyFrame&;

    Iterator(const KeyFrames& frames, std::size_t position) : frames_(&frames), position_(position) {}
    const KeyFrame& operator*() const { return (*frames_)[position_]; }
    const KeyFrame* operator->() const { return &(*frames_)[position_]; }
    Iterator& operator++() {
      ++position_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return position_ == other.position_; }
    bool operator!=(const Iterator& other) const { return position_ != other.position_; }

   private:
    const KeyFrames* frames_;
    std::size_t position_;
  };

  std::size_t size() const { return order_.size(); }
  bool empty() const { return order_.empty(); }
  /// The key frame at this position in the sorted order.
  const KeyFrame& operator[](std::size_t position) const { return *frames_.find(order_[position]); }
  const KeyFrame& front() const { return (*this)[0]; }
  const KeyFrame& back() const { return (*this)[size() - 1]; }
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

  /// Null if there is none.
  const KeyFrame* find(base::KeyFrameId id) const { return frames_.find(id); }
  /// Throws Error(internal) if there is none, as position() and edit() do.
  const KeyFrame& at(base::KeyFrameId id) const;
  std::size_t position(base::KeyFrameId id) const;
  /// Position of the first key frame of the session at or after `stamp`; the end of the session if all are earlier.
  std::size_t lowerBound(std::uint16_t session, base::Stamp stamp) const;

  /// The id for the next key frame of a session.
  base::KeyFrameId nextId(std::uint16_t session) const { return frames_.nextId(session); }
  /// Inserts a key frame in order and returns its position. Throws Error(internal) if the frame's id was used before,
  /// or if its session has a key frame with the same stamp.
  std::size_t insert(KeyFrame frame);
  /// The key frame, for changes of anything but its id and stamp. The reference is valid until the key frames are
  /// copied or insert() runs.
  KeyFrame& edit(base::KeyFrameId id);

 private:
  base::IdTable<base::KeyFrameId, KeyFrame> frames_;
  std::vector<base::KeyFrameId> order_;
};

}  // namespace omnimapper::map
