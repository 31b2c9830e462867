#pragma once

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <tuple>

namespace omnimapper::base {

/// Identifies an object in a map by the session that created it and its index within that session. Ids of different
/// kinds of objects are different types. Ids are ordered by session, then by index, which is the order of creation.
template <class Tag>
struct Id {
  std::uint16_t session = 0;
  std::uint32_t index = 0;

  friend bool operator==(Id a, Id b) { return a.session == b.session && a.index == b.index; }
  friend bool operator!=(Id a, Id b) { return !(a == b); }
  friend bool operator<(Id a, Id b) { return std::tie(a.session, a.index) < std::tie(b.session, b.index); }
};

/// "session:index", for logs and messages.
template <class Tag>
std::string toString(Id<Tag> id) {
  return std::to_string(id.session) + ":" + std::to_string(id.index);
}

template <class Tag>
std::ostream& operator<<(std::ostream& out, Id<Tag> id) {
  return out << toString(id);
}

using VariableId = Id<struct VariableTag>;
using FactorId = Id<struct FactorTag>;
using KeyFrameId = Id<struct KeyFrameTag>;
using LandmarkId = Id<struct LandmarkTag>;

}  // namespace omnimapper::base

template <class Tag>
struct std::hash<omnimapper::base::Id<Tag>> {
  std::size_t operator()(omnimapper::base::Id<Tag> id) const noexcept {
    return std::hash<std::uint64_t>{}((std::uint64_t{id.session} << 32) | id.index);
  }
};
