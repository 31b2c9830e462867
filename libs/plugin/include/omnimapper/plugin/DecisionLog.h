#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/base/Stamp.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::map {
struct KeyFrame;
}

namespace omnimapper::mapper {

/// One association or closure that was considered, and why it was accepted or refused.
struct Decision {
  Decision() = default;
  /// A decision of the plugin of this INI section, made at a key frame.
  Decision(const map::KeyFrame& frame, std::string plugin_section, std::string kind_of_decision);

  base::Stamp stamp;                                    ///< of the key frame at which the decision was made
  std::string plugin;                                   ///< INI section of the plugin that decided
  std::string kind;                                     ///< for users: "loop closure", "absolute pose", ...
  base::KeyFrameId from;                                ///< the key frame it was made at
  std::optional<base::KeyFrameId> to;                   ///< for a closure, the other key frame
  bool accepted = false;                                ///< for a hypothesis, its current state
  std::string reason;                                   ///< a few words a user understands
  std::vector<std::pair<std::string, double>> numbers;  ///< the numbers behind it: name with unit, value
  /// If the decision is about a hypothesis: its factor, about which the consistency test decides. `accepted` is then
  /// its current state.
  std::optional<base::FactorId> hypothesis = {};
  bool is_loop_closure = false;  ///< whether it is about key frames `from` and `to` that do not follow one another
};

/// The kind of a decision about a search for a session in the whole map. If the decision is accepted, the session was
/// moved to the place that was found, and a loop closure must still confirm this place.
inline constexpr char kRelocalization[] = "relocalization";

using DecisionLog = std::vector<Decision>;

/// Counts of the pairs of key frames for which a loop closure was considered, each pair once. A pair counts as accepted
/// if any decision about it is accepted, because a closure may be accepted after it was refused.
struct ClosureCounts {
  std::size_t accepted = 0, refused = 0;
};
ClosureCounts countClosures(const DecisionLog& decisions);

}  // namespace omnimapper::mapper
