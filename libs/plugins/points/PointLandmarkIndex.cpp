#include "PointLandmarkIndex.h"

#include "PointPayload.h"

namespace omnimapper::plugins {

void PointLandmarkIndex::restore(const mapper::State& state) {
  for (const auto id : state.candidates(owner_)) add(id);
  update(state);
}

void PointLandmarkIndex::update(const mapper::State& state) {
  of_numbers_.clear();
  for (auto at = variables_.begin(); at != variables_.end();) {
    const map::Landmark* landmark = state.map.landmarks.find(at->first);
    if (!landmark || landmark->state != map::Landmark::State::active) {
      at = variables_.erase(at);
      continue;
    }
    at->second = landmark->variables.front();
    const std::int32_t number = dynamic_cast<const PointPayload&>(*landmark->payload).number;
    if (number >= 0) of_numbers_[number] = at->first;
    ++at;
  }
}

std::optional<base::LandmarkId> PointLandmarkIndex::ofNumber(std::int32_t number) const {
  const auto found = of_numbers_.find(number);
  return found == of_numbers_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace omnimapper::plugins
