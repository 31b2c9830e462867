#pragma once

#include <omnimapper/eval/Alignment.h>

namespace omnimapper::eval {

/// How poses of estimate and reference are brought together.
struct PairingOptions {
  base::Duration tolerance = base::durationFromSeconds(0.01);  ///< of association by stamp
  base::Duration longest_gap{0};  ///< above zero: interpolate the reference over gaps up to this, no association
  Alignment alignment = Alignment::none;
};

struct PairedTrajectories {
  std::vector<PosePair> pairs;         ///< estimate aligned to the reference
  Similarity reference_from_estimate;  ///< what aligned it
  std::size_t unpaired = 0;            ///< poses of the estimate without partner
};

/// Throws Error(unreadable_input) if no two poses belong together, and as fitAlignment().
PairedTrajectories pairTrajectories(const Trajectory& estimate, const Trajectory& reference,
                                    const PairingOptions& options);

}  // namespace omnimapper::eval
