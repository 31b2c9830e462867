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

namespace {

// Mean rotation between estimate and reference over all poses [rad].
double commonTurn(const std::vector<PosePair>& pairs) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& pair : pairs) mean += geometry::logSo3(pair.reference.rotation * pair.estimate.rotation.conjugate());
  return (mean / static_cast<double>(pairs.size())).norm();
}

}  // namespace

std::string hintsOn(const AbsoluteTrajectoryError& error, Alignment alignment) {
  constexpr double kFar = 1, kTurned = 10 * geometry::kPi / 180;  // [m] [rad]
  std::string hints;
  const auto& first = error.paired.pairs.front();
  if (alignment == Alignment::none && (first.reference.translation - first.estimate.translation).norm() > kFar)
    hints +=
        "The first poses of estimate and reference lie more than 1 m apart. If the trajectories are in different "
        "frames, use --align yaw or --align se3.\n";
  const bool is_fitted = alignment == Alignment::yaw || alignment == Alignment::se3 || alignment == Alignment::sim3;
  constexpr double kNotable = geometry::kPi / 180;  // [rad]
  const double common = commonTurn(error.paired.pairs);
  if (is_fitted && error.rotation.rmse <= kTurned && common > kNotable &&
      2 * common * common > error.rotation.rmse * error.rotation.rmse)
    hints +=
        "Most of the rotation error is the same at all poses: the alignment rotates the estimate by its positions "
        "alone, which hardly determine the rotation if they lie close together. --align first takes the rotation from "
        "the first pose.\n";
  if (error.rotation.rmse <= kTurned) return hints;
  hints += "The orientations of estimate and reference differ by more than 10 deg.";
  if (alignment == Alignment::none || alignment == Alignment::first || alignment == Alignment::yaw)
    hints += " If one of the frames is not level, as that of a camera in the hand, use --align se3.";
  return hints +
         " If the reference is of a camera that looks along z, use OUT.truth.tum of omnimapper-import instead.\n";
}

}  // namespace omnimapper::eval
