#include "SlipEvidence.h"

#include <algorithm>

#include "EvidenceText.h"
#include "SlipSearch.h"

namespace omnimapper::plugins {

using mapper::Evidence;

std::vector<Evidence> slips(const mapper::State& state, const std::string& section,
                            const mapper::DecisionLog& decisions) {
  std::vector<Evidence> all;
  const auto stampOf = [&](base::KeyFrameId id) { return state.map.keyFrame(id).stamp; };
  const mapper::Decision* contradiction = nullptr;
  Evidence undone{"slips_undone", 0, Evidence::Says::good, ""};
  for (const auto& decision : decisions) {
    if (decision.plugin != section || decision.kind != kSlip) continue;
    if (!decision.accepted) {
      contradiction = &decision;
      continue;
    }
    double metres = 0, degrees = 0;
    for (const auto& [name, value] : decision.numbers) {
      if (name == kSlippedBy) metres = value;
      if (name == kSlippedByAngle) degrees = value;
    }
    ++undone.value;
    undone.reason += (undone.reason.empty() ? "" : "; ") +
                     evidenceText("a slip of %.1f m and %.0f deg, %s, was undone", metres, degrees,
                                  afterStart(state.map, state.map.keyFrame(decision.from)).c_str());
  }
  if (undone.value > 0) all.push_back(undone);
  if (!contradiction) return all;
  // An accepted closure across the contradiction resolves it: from a later key frame to one before the closures' place.
  const bool is_resolved = std::any_of(decisions.begin(), decisions.end(), [&](const mapper::Decision& decision) {
    return decision.plugin == section && decision.is_loop_closure && decision.accepted && decision.to &&
           stampOf(decision.from) >= contradiction->stamp && stampOf(*decision.to) <= stampOf(*contradiction->to);
  });
  if (is_resolved) return all;
  const auto& frame = state.map.keyFrame(contradiction->from);
  all.push_back({"contradicted_after_s", base::secondsBetween(state.map.key_frames.begin()->stamp, frame.stamp),
                 Evidence::Says::against_it,
                 evidenceText("from %s on, several closures that agree with one another contradict the map",
                              afterStart(state.map, frame).c_str())});
  return all;
}

}  // namespace omnimapper::plugins
