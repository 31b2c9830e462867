#include <omnimapper/plugin/State.h>

#include <algorithm>

namespace omnimapper::mapper {

bool State::areAligned(std::uint16_t session, std::uint16_t other) const {
  if (session == other) return true;
  return std::all_of(map.sessions.begin(), map.sessions.end(), [&](const map::Session& known) {
    return known.aligned || (known.number != session && known.number != other);
  });
}

std::vector<base::FactorId> State::factorsOf(base::LandmarkId id) const {
  std::vector<base::FactorId> factors;
  for (const auto variable : map.landmark(id).variables) {
    const auto& bound = graph.factorsOf(variable);
    factors.insert(factors.end(), bound.begin(), bound.end());
  }
  std::sort(factors.begin(), factors.end());
  factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
  return factors;
}

std::vector<base::LandmarkId> State::candidates(const std::string& owner) const {
  std::vector<base::LandmarkId> active;
  for (const auto& [id, landmark] : map.landmarks) {
    if (landmark.owner == owner && landmark.state == map::Landmark::State::active) active.push_back(id);
  }
  return active;
}

}  // namespace omnimapper::mapper
