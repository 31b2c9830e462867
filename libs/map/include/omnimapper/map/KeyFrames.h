#pragma once

#include <omnimapper/base/IdTable.h>
#include <omnimapper/map/KeyFrame.h>

#include <cstddef>
#include <iterator>
#include <vector>

namespace omnimapper::map {

/// The key frames of a map in the order they were driven: by session, then stamp. Ids are given in the order of commit,
/// so a key frame that came late has a larger id than its successor. Copies share the key frames that neither changed.
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
  /// The key frame at a position in the order above.
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
  /// Inserts it in order and returns its position. Throws Error(internal) if its session has used the id or stamp.
  std::size_t insert(KeyFrame frame);
  /// For changes of anything but id and stamp. The reference is valid until the key frames are copied or insert() runs.
  KeyFrame& edit(base::KeyFrameId id);

 private:
  base::IdTable<base::KeyFrameId, KeyFrame> frames_;
  std::vector<base::KeyFrameId> order_;
};

}  // namespace omnimapper::map
