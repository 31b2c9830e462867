#pragma once

#include <omnimapper/eval/Pairing.h>
#include <omnimapper/eval/Statistics.h>

#include <string>

namespace omnimapper::eval {

enum class DeltaUnit { frames, seconds, metres };

/// The unit with the name "frames", "s" or "m". Throws Error(command_line) that lists these names for any other name.
DeltaUnit deltaUnitNamed(const std::string& name);

/// The span over which motion is compared.
struct Delta {
  double value = 1;
  DeltaUnit unit = DeltaUnit::frames;
};

struct RelativePoseError {
  Statistics translation;                  ///< [m]
  Statistics rotation;                     ///< [rad]
  std::vector<base::Stamp> stamps;         ///< stamp at the start of each span
  std::vector<double> translation_errors;  ///< of each span [m]
  std::vector<double> rotation_errors;     ///< of each span [rad], in [0, pi]
  std::size_t unpaired = 0;                ///< poses of the estimate that are in no pair
};

/// A pair is a pose of the estimate (est) with the pose of the reference (ref) at the same time. For every pair i and
/// the pair j one delta later: E = (ref_i^-1 ref_j)^-1 (est_i^-1 est_j). The errors are the length of E's translation
/// and the angle of E's rotation. The delta is a number of pairs (frames), a difference of the estimate's stamps
/// (seconds) or the distance that the reference travels (metres). The pair j is that later pair whose span from i is
/// nearest to the delta. Spans that differ from the delta by more than a tenth are left out; in frames a span must be
/// exact. Of the alignments (Alignment.h) only sim3, which scales the estimate, changes the result. Source: Sturm et
/// al., IROS 2012. Throws Error(unreadable_input) if no span has this delta, Error(out_of_range) if the delta is not
/// positive or not a whole number of frames, and as pairTrajectories() does.
RelativePoseError relativePoseError(const Trajectory& estimate, const Trajectory& reference,
                                    const PairingOptions& options = {}, const Delta& delta = {});

}  // namespace omnimapper::eval
