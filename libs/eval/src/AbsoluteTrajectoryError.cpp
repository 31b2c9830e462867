#include <omnimapper/eval/AbsoluteTrajectoryError.h>

namespace omnimapper::eval {

AbsoluteTrajectoryError absoluteTrajectoryError(const Trajectory& estimate, const Trajectory& reference,
                                                const PairingOptions& options) {
  AbsoluteTrajectoryError result;
  result.paired = pairTrajectories(estimate, reference, options);
  for (const auto& pair : result.paired.pairs) {
    const geometry::Vector6d error = minus(pair.estimate, pair.reference);
    result.translation_errors.push_back(error.head<3>().norm());
    result.rotation_errors.push_back(error.tail<3>().norm());
  }
  result.translation = statisticsOf(result.translation_errors);
  result.rotation = statisticsOf(result.rotation_errors);
  return result;
}

}  // namespace omnimapper::eval
