#include <omnimapper/mapper/ReleaseQueue.h>

#include <utility>

namespace omnimapper::mapper {

bool ReleaseQueue::add(const mrpt::obs::CObservation::Ptr& observation) {
  if (released_ && observation->timestamp <= *released_) return false;
  groups_[observation->timestamp].push_back(observation);
  return true;
}

void ReleaseQueue::advanceTo(base::Stamp stamp) {
  if (!newest_ || stamp > *newest_) newest_ = stamp;
}

std::optional<ReleaseQueue::Group> ReleaseQueue::next(bool drain) {
  if (groups_.empty()) return std::nullopt;
  const auto first = groups_.begin();
  if (!drain && (!newest_ || first->first + window_ > *newest_)) return std::nullopt;
  released_ = first->first;
  Group group{first->first, std::move(first->second)};
  groups_.erase(first);
  return group;
}

}  // namespace omnimapper::mapper
