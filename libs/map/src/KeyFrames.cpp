#include <omnimapper/base/Error.h>
#include <omnimapper/map/KeyFrames.h>

#include <algorithm>
#include <string>
#include <tuple>

namespace omnimapper::map {

namespace {
[[noreturn]] void fail(base::KeyFrameId id, const std::string& what) {
  throw base::Error(base::ExitCode::internal, "key frame " + toString(id) + " " + what);
}
}  // namespace

const KeyFrame& KeyFrames::at(base::KeyFrameId id) const {
  const KeyFrame* frame = frames_.find(id);
  if (!frame) fail(id, "is not among the " + std::to_string(size()) + " key frames of the map");
  return *frame;
}

std::size_t KeyFrames::position(base::KeyFrameId id) const {
  return lowerBound(id.session, at(id).stamp);
}

std::size_t KeyFrames::lowerBound(std::uint16_t session, base::Stamp stamp) const {
  const auto place = std::lower_bound(
      order_.begin(), order_.end(), std::tuple(session, stamp),
      [&](base::KeyFrameId id, auto wanted) { return std::tuple(id.session, frames_.find(id)->stamp) < wanted; });
  return static_cast<std::size_t>(place - order_.begin());
}

std::size_t KeyFrames::insert(KeyFrame frame) {
  const base::KeyFrameId id = frame.id;
  // It usually is the newest.
  const bool last = empty() || std::tuple(back().id.session, back().stamp) < std::tuple(id.session, frame.stamp);
  const std::size_t position = last ? size() : lowerBound(id.session, frame.stamp);
  if (id.index < frames_.nextId(id.session).index) fail(id, "cannot be inserted: its id was used before");
  const bool taken =
      position < size() && (*this)[position].id.session == id.session && (*this)[position].stamp == frame.stamp;
  if (taken) fail(id, "cannot be inserted: it has the stamp of " + toString((*this)[position].id));
  while (frames_.nextId(id.session).index < id.index) frames_.skip(id.session);
  frames_.add(id.session, std::move(frame));
  order_.insert(order_.begin() + static_cast<std::ptrdiff_t>(position), id);
  return position;
}

KeyFrame& KeyFrames::edit(base::KeyFrameId id) {
  at(id);
  return *frames_.edit(id);
}

}  // namespace omnimapper::map
