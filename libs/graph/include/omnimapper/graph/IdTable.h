#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace omnimapper::graph {

/// Things by their id. Look-up, insertion and removal take constant time; iteration is in the order of ids; an index is
/// never given twice.
template <class IdType, class Value>
class IdTable {
 public:
  /// Steps over what is there; *it is {id, value}.
  class Iterator {
   public:
    std::pair<IdType, const Value&> operator*() const {
      return {IdType{session_->first, index_}, *session_->second[index_]};
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
    using Session = typename std::map<std::uint16_t, std::vector<std::optional<Value>>>::const_iterator;
    Iterator(Session session, Session end) : session_(session), end_(end) { skipHoles(); }
    void skipHoles() {
      while (session_ != end_) {
        while (index_ < session_->second.size() && !session_->second[index_]) ++index_;
        if (index_ < session_->second.size()) return;
        index_ = 0;
        ++session_;
      }
    }
    Session session_, end_;
    std::uint32_t index_ = 0;
  };

  Iterator begin() const { return Iterator(sessions_.begin(), sessions_.end()); }
  Iterator end() const { return Iterator(sessions_.end(), sessions_.end()); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  /// Gives it the session's next index.
  IdType add(std::uint16_t session, Value value) {
    std::vector<std::optional<Value>>& values = sessions_[session];
    values.emplace_back(std::move(value));
    ++size_;
    return {session, static_cast<std::uint32_t>(values.size() - 1)};
  }
  /// False, and nothing done, if there is no such id.
  bool erase(IdType id) {
    if (!find(id)) return false;
    sessions_[id.session][id.index].reset();
    --size_;
    return true;
  }
  const Value* find(IdType id) const {
    const auto session = sessions_.find(id.session);
    if (session == sessions_.end() || id.index >= session->second.size()) return nullptr;
    const std::optional<Value>& value = session->second[id.index];
    return value ? &*value : nullptr;
  }
  Value* find(IdType id) { return const_cast<Value*>(std::as_const(*this).find(id)); }

  /// The index that add() will give next, of every session that ever had one.
  std::map<std::uint16_t, std::uint32_t> nextIndices() const {
    std::map<std::uint16_t, std::uint32_t> next;
    for (const auto& [session, values] : sessions_) next[session] = static_cast<std::uint32_t>(values.size());
    return next;
  }
  /// Leaves a hole where add() would have put something; how a table is rebuilt with the ids it had.
  void skip(std::uint16_t session) { sessions_[session].emplace_back(); }

 private:
  std::map<std::uint16_t, std::vector<std::optional<Value>>> sessions_;
  std::size_t size_ = 0;
};

}  // namespace omnimapper::graph
