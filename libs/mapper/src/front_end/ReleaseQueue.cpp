#include "front_end/ReleaseQueue.h"

#include <algorithm>
#include <utility>

namespace omnimapper::mapper {

bool ReleaseQueue::add(const mrpt::obs::CObservation::Ptr& observation) {
  if (released_ && observation->timestamp <= *released_) return false;
  groups_[observation->timestamp].push_back(observation);
  return true;
}

bool ReleaseQueue::holds(const mrpt::obs::CObservation& observation) const {
  const auto group = groups_.find(observation.timestamp);
  return group != groups_.end() && std::any_of(group->second.begin(), group->second.end(), [&](const auto& other) {
           return other->sensorLabel == observation.sensorLabel &&
                  other->GetRuntimeClass() == observation.GetRuntimeClass();
         });
}

std::optional<base::Stamp> ReleaseQueue::due() const {
  if (groups_.empty() || !now_ || groups_.begin()->first + window_ > *now_) return std::nullopt;
  return groups_.begin()->first;
}

std::optional<ReleaseQueue::Group> ReleaseQueue::next() {
  if (groups_.empty()) return std::nullopt;
  const auto first = groups_.begin();
  released_ = first->first;
  Group group{first->first, std::move(first->second)};
  groups_.erase(first);
  return group;
}

}  // namespace omnimapper::mapper
