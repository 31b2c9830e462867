#pragma once

#include <omnimapper/base/Id.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace omnimapper::base {

/// A table of values by id. Look-up, insertion and removal take constant time; iteration is in the order of ids. An
/// index is never used twice. The values are kept in chunks of 64 indices, and a chunk without values is freed. A copy
/// shares each chunk with the original until one of the two tables changes it, so copying costs one pointer for every
/// 64 values. A copy may be read in another thread while the original changes, as long as the copy is destroyed by the
/// thread that changes the original.
template <class IdType, class Value>
class IdTable {
  static constexpr std::uint32_t kChunkSize = 64;
  using Chunk = std::array<std::optional<Value>, kChunkSize>;
  struct Session {
    std::vector<std::shared_ptr<Chunk>> chunks;  // null if none of the 64 indices has a value
    std::uint32_t next = 0;
    // Null if there is no value.
    const Value* at(std::uint32_t index) const {
      const auto& chunk = chunks[index / kChunkSize];
      if (!chunk) return nullptr;
      const std::optional<Value>& value = (*chunk)[index % kChunkSize];
      return value ? &*value : nullptr;
    }
  };
  using Sessions = std::map<std::uint16_t, Session>;

 public:
  /// Iterates over the existing values. Dereferencing gives the pair {id, value}.
  class Iterator {
   public:
    std::pair<IdType, const Value&> operator*() const {
      return {IdType{session_->first, index_}, *session_->second.at(index_)};
    }
    Iterator& operator++() {
      ++index_;
      skipHoles();
      return *this;
    }
    bool operator!=(const Iterator& other) const { return session_ != other.session_ || index_ != other.index_; }
    bool operator==(const Iterator& other) const { return !(*this != other); }

   private:
    friend class IdTable;
    using Place = typename Sessions::const_iterator;
    Iterator(Place session, Place end) : session_(session), end_(end) { skipHoles(); }
    void skipHoles() {
      while (session_ != end_) {
        const Session& session = session_->second;
        while (index_ < session.next && !session.at(index_)) {
          index_ = session.chunks[index_ / kChunkSize] ? index_ + 1 : (index_ / kChunkSize + 1) * kChunkSize;
        }
        if (index_ < session_->second.next) return;
        index_ = 0;
        ++session_;
      }
    }
    Place session_, end_;
    std::uint32_t index_ = 0;
  };

  Iterator begin() const { return Iterator(sessions_.begin(), sessions_.end()); }
  Iterator end() const { return Iterator(sessions_.end(), sessions_.end()); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  /// The id that add() would give.
  IdType nextId(std::uint16_t session) const {
    const auto found = sessions_.find(session);
    return {session, found == sessions_.end() ? 0 : found->second.next};
  }
  /// Adds a value with the session's next index.
  IdType add(std::uint16_t session, Value value) {
    const std::uint32_t index = skip(session);
    ownChunk(sessions_[session], index)[index % kChunkSize] = std::move(value);
    ++size_;
    return {session, index};
  }
  /// Removes a value. Returns false if there is no such id.
  bool erase(IdType id) {
    if (!find(id)) return false;
    Session& session = sessions_[id.session];
    Chunk& chunk = ownChunk(session, id.index);
    chunk[id.index % kChunkSize].reset();
    const bool is_empty = std::none_of(chunk.begin(), chunk.end(), [](const auto& value) { return value.has_value(); });
    if (is_empty) session.chunks[id.index / kChunkSize].reset();
    --size_;
    return true;
  }
  const Value* find(IdType id) const {
    const auto session = sessions_.find(id.session);
    if (session == sessions_.end() || id.index >= session->second.next) return nullptr;
    return session->second.at(id.index);
  }
  /// The value for editing; null if there is no such id. The pointer is valid until the table is copied or the value
  /// erased.
  Value* edit(IdType id) {
    if (!find(id)) return nullptr;
    return &*ownChunk(sessions_[id.session], id.index)[id.index % kChunkSize];
  }

  /// Calls visit(id, mine, other's) for ids whose values may differ between this table and another, in the order of
  /// ids; null where there is no value. Chunks that the two share are passed over, so that the time grows with what was
  /// changed since one was copied from the other.
  template <class Visit>
  void visitUnshared(const IdTable& other, const Visit& visit) const {
    static const Session kNone;
    for (auto mine = sessions_.begin(), theirs = other.sessions_.begin();
         mine != sessions_.end() || theirs != other.sessions_.end();) {
      const bool is_mine = theirs == other.sessions_.end() || (mine != sessions_.end() && mine->first <= theirs->first);
      const bool is_theirs =
          mine == sessions_.end() || (theirs != other.sessions_.end() && theirs->first <= mine->first);
      const std::uint16_t number = is_mine ? mine->first : theirs->first;
      visitUnshared(number, is_mine ? mine->second : kNone, is_theirs ? theirs->second : kNone, visit);
      if (is_mine) ++mine;
      if (is_theirs) ++theirs;
    }
  }

  /// For every session that ever had an index: the index that add() will use next.
  std::map<std::uint16_t, std::uint32_t> nextIndices() const {
    std::map<std::uint16_t, std::uint32_t> next;
    for (const auto& [number, session] : sessions_) next[number] = session.next;
    return next;
  }
  /// Skips an index without adding a value; used to rebuild a table with its former ids.
  std::uint32_t skip(std::uint16_t session) {
    Session& values = sessions_[session];
    if (values.next % kChunkSize == 0) values.chunks.push_back(nullptr);
    return values.next++;
  }

 private:
  template <class Visit>
  static void visitUnshared(std::uint16_t number, const Session& mine, const Session& theirs, const Visit& visit) {
    const auto chunkOf = [](const Session& session, std::size_t i) -> const Chunk* {
      return i < session.chunks.size() ? session.chunks[i].get() : nullptr;
    };
    for (std::size_t i = 0; i < std::max(mine.chunks.size(), theirs.chunks.size()); ++i) {
      const Chunk *own = chunkOf(mine, i), *other = chunkOf(theirs, i);
      if (own == other) continue;
      for (std::uint32_t k = 0; k < kChunkSize; ++k) {
        const Value* a = own && (*own)[k] ? &*(*own)[k] : nullptr;
        const Value* b = other && (*other)[k] ? &*(*other)[k] : nullptr;
        if (a || b) visit(IdType{number, static_cast<std::uint32_t>(i) * kChunkSize + k}, a, b);
      }
    }
  }
  Chunk& ownChunk(Session& session, std::uint32_t index) {
    std::shared_ptr<Chunk>& chunk = session.chunks[index / kChunkSize];
    if (!chunk) chunk = std::make_shared<Chunk>();
    if (chunk.use_count() > 1) chunk = std::make_shared<Chunk>(*chunk);
    return *chunk;
  }

  Sessions sessions_;
  std::size_t size_ = 0;
};

}  // namespace omnimapper::base
