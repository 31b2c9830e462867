#include <omnimapper/map/KeyFrame.h>
#include <omnimapper/plugin/DecisionLog.h>

#include <map>
#include <utility>

namespace omnimapper::mapper {

Decision::Decision(const map::KeyFrame& frame, std::string plugin_section, std::string kind_of_decision)
    : stamp(frame.stamp), plugin(std::move(plugin_section)), kind(std::move(kind_of_decision)), from(frame.id) {}

ClosureCounts countClosures(const DecisionLog& decisions) {
  std::map<std::pair<base::KeyFrameId, base::KeyFrameId>, bool> accepted;
  for (const Decision& decision : decisions) {
    if (!decision.is_loop_closure || !decision.to) continue;
    bool& is_accepted = accepted[{decision.from, *decision.to}];
    is_accepted = is_accepted || decision.accepted;
  }
  ClosureCounts counts;
  for (const auto& [pair, is_accepted] : accepted) ++(is_accepted ? counts.accepted : counts.refused);
  return counts;
}

}  // namespace omnimapper::mapper
