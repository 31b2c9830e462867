#pragma once

#include <omnimapper/base/Id.h>
#include <omnimapper/base/Stamp.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::mapper {

/// One association or closure that was considered, and why it was taken or refused.
struct Decision {
  base::Stamp stamp;                                    ///< of the key frame it was made at
  std::string plugin;                                   ///< INI section of who decided
  std::string kind;                                     ///< for people: "loop closure", "absolute pose", ...
  base::KeyFrameId from;                                ///< the key frame it was made at
  std::optional<base::KeyFrameId> to;                   ///< the other one, of a closure
  bool accepted = false;                                ///< of a hypothesis: as it stands now
  std::string reason;                                   ///< a few words a user understands
  std::vector<std::pair<std::string, double>> numbers;  ///< what it was decided on: name with unit, value
  /// The factor that the consistency test decides about, if it is a hypothesis; `accepted` is how it stands now.
  std::optional<base::FactorId> hypothesis = {};
  bool is_loop_closure = false;  ///< it is about two key frames that do not follow one another, `from` and `to`
};

/// The kind of a decision that looked for a session in the whole map; accepted, the session was moved there, and a loop
/// closure must yet confirm it.
inline constexpr char kRelocalisation[] = "relocalisation";

using DecisionLog = std::vector<Decision>;

/// Pairs of key frames that a loop closure was considered between, each once: accepted if any decision about it is, as
/// one that was taken again after it had been refused.
struct ClosureCounts {
  std::size_t accepted = 0, refused = 0;
};
ClosureCounts countClosures(const DecisionLog& decisions);

}  // namespace omnimapper::mapper
