#pragma once

#include <omnimapper/eval/Pairing.h>
#include <omnimapper/eval/Statistics.h>

#include <string>
#include <vector>

namespace omnimapper::eval {

struct AbsoluteTrajectoryError {
  Statistics translation;                  ///< [m]
  Statistics rotation;                     ///< [rad]
  std::vector<double> translation_errors;  ///< of each pair [m]
  std::vector<double> rotation_errors;     ///< of each pair [rad], in [0, pi]
  PairedTrajectories paired;
};

/// Distance and angle between each pose of the estimate and the pose of the reference with which it is paired. Source:
/// Sturm et al., A Benchmark for the Evaluation of RGB-D SLAM Systems, IROS 2012, which has the distance only. Throws
/// as pairTrajectories() does.
AbsoluteTrajectoryError absoluteTrajectoryError(const Trajectory& estimate, const Trajectory& reference,
                                                const PairingOptions& options = {});

/// Sentences for the user on what may be wrong with the comparison rather than with the estimate; empty if nothing
/// seems wrong with it.
std::string hintsOn(const AbsoluteTrajectoryError& error, Alignment alignment);

}  // namespace omnimapper::eval
