#pragma once

#include <omnimapper/eval/Pairing.h>
#include <omnimapper/eval/Statistics.h>

#include <string>

namespace omnimapper::eval {

enum class DeltaUnit { frames, seconds, metres };

/// "frames", "s" or "m". Throws Error(command_line) that lists them.
DeltaUnit deltaUnitNamed(const std::string& name);

/// The span over which motion is compared.
struct Delta {
  double value = 1;
  DeltaUnit unit = DeltaUnit::frames;
};

struct RelativePoseError {
  Statistics translation;                  ///< [m]
  Statistics rotation;                     ///< [rad]
  std::vector<base::Stamp> stamps;         ///< at the start of each span
  std::vector<double> translation_errors;  ///< of each span [m]
  std::vector<double> rotation_errors;     ///< of each span [rad], in [0, pi]
  std::size_t unpaired = 0;                ///< poses of the estimate that are in no pair
};

/// For every pair i and the pair j one delta later: E = (ref_i^-1 ref_j)^-1 (est_i^-1 est_j), its length and its angle.
/// Frames count pairs, seconds the estimate's stamps, metres the distance travelled by the reference: j is the pair
/// nearest to the delta, and spans that differ from it by more than a tenth are left out. Of all alignments only sim3
/// changes the result, by its scale. Source: Sturm et al., IROS 2012. Throws Error(unreadable_input) if no span of that
/// delta exists, Error(out_of_range) for a delta that is not positive or no whole number of frames, and as
/// pairTrajectories().
RelativePoseError relativePoseError(const Trajectory& estimate, const Trajectory& reference,
                                    const PairingOptions& options = {}, const Delta& delta = {});

}  // namespace omnimapper::eval
