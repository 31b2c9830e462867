#include "back_end/MapEvidence.h"

#include <omnimapper/derived/SessionAlignment.h>

#include <iterator>
#include <utility>

#include "back_end/judgeTilt.h"

namespace omnimapper::mapper {

// The evidence of the plugins in these sections.
std::vector<Evidence> MapEvidence::ofPlugins(const std::function<bool(const std::string&)>& is_asked) {
  std::vector<Evidence> evidence;
  const auto collect = [&](const auto& plugins, const auto& evidence_of) {
    for (const auto& [section, plugin] : plugins) {
      if (!is_asked(section)) continue;
      const auto timer = state_.times.measure(Stage::plugin, section);
      auto some = evidence_of(*plugin);
      evidence.insert(evidence.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
    }
  };
  collect(plugins_.pose, [](const PosePlugin& plugin) { return plugin.evidence(); });
  collect(plugins_.measurement, [this](const MeasurementPlugin& plugin) { return plugin.evidence(state_.view()); });
  return evidence;
}

void MapEvidence::keep(const std::function<bool(const std::string&)>& is_removed) {
  auto evidence = ofPlugins(is_removed);
  std::move(evidence.begin(), evidence.end(), std::back_inserter(of_removed_));
}

// Sessions that nothing ties to the map, or whose ties were mostly refused.
std::vector<Evidence> MapEvidence::ofSessions() const {
  std::vector<Evidence> evidence;
  for (const auto& session : state_.map.sessions) {
    const std::string name = "session_" + std::to_string(session.number);
    const auto ties = derived::testedTies(state_.graph, session.number);
    if (!session.aligned) {
      evidence.push_back({name + "_not_aligned", 1, Evidence::Says::against_it,
                          derived::alignedText(session) + " with the map and lies at its assumed start"});
    } else if (ties.areMostlyRefused()) {
      evidence.push_back({name + "_ties_refused", static_cast<double>(ties.refused), Evidence::Says::against_it,
                          std::to_string(ties.refused) + " of the " + std::to_string(ties.refused + ties.accepted) +
                              " measurements that tie session " + std::to_string(session.number) +
                              " to the map do not fit, or were not confirmed"});
    }
  }
  return evidence;
}

void MapEvidence::judge() {
  auto evidence = of_input_;
  evidence.insert(evidence.end(), of_removed_.begin(), of_removed_.end());
  const auto add = [&](std::vector<Evidence> some) {
    std::move(some.begin(), some.end(), std::back_inserter(evidence));
  };
  add(ofPlugins([](const std::string&) { return true; }));
  if (!state_.map_is_held) add(ofSessions());
  if (motion_ == Motion::planar) {
    if (auto tilted = judgeTilt(state_.map)) evidence.push_back(std::move(*tilted));
  }
  state_.verdict = conclude(std::move(evidence));
}

}  // namespace omnimapper::mapper
