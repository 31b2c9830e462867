#pragma once

#include <omnimapper/eval/Alignment.h>

namespace omnimapper::eval {

/// How poses of the estimate are paired with poses of the reference.
struct PairingOptions {
  base::Duration tolerance = base::durationFromSeconds(0.01);  ///< largest difference of the stamps of a pair
  /// If above zero, `tolerance` is not used: the reference is interpolated to the stamps of the estimate, over gaps up
  /// to this length.
  base::Duration longest_gap{0};
  Alignment alignment = Alignment::none;
};

struct PairedTrajectories {
  std::vector<PosePair> pairs;         ///< with the estimate aligned to the reference
  Similarity reference_from_estimate;  ///< the alignment that was applied to the estimate
  std::size_t unpaired = 0;            ///< poses of the estimate that are in no pair
};

/// Throws Error(unreadable_input) if no poses can be paired, and as fitAlignment() does.
PairedTrajectories pairTrajectories(const Trajectory& estimate, const Trajectory& reference,
                                    const PairingOptions& options);

}  // namespace omnimapper::eval
