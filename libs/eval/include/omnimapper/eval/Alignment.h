#pragma once

#include <omnimapper/eval/PosePairs.h>

#include <Eigen/Core>
#include <string>

namespace omnimapper::eval {

/// The kind of motion by which the estimate is fitted to the reference before the estimate is judged.
enum class Alignment {
  none,   ///< no motion: both are in the same frame
  first,  ///< the motion with which the two poses of the first pair agree exactly
  yaw,    ///< translation and rotation about z, least squares over positions; for frames with the same vertical
  se3,    ///< translation and rotation, least squares over positions
  sim3,   ///< translation, rotation and scale, least squares over positions
};

/// The alignment whose name above is `name`. Throws Error(command_line) with a list of the names if there is none.
Alignment alignmentNamed(const std::string& name);

/// reference_from_estimate: p_in_reference = scale * R p_in_estimate + t; orientations are rotated by R.
struct Similarity {
  double scale = 1;
  geometry::Se3 motion;  ///< R and t
};

Eigen::Vector3d operator*(const Similarity& reference_from_estimate, const Eigen::Vector3d& p_in_estimate);
geometry::Se3 operator*(const Similarity& reference_from_estimate, const geometry::Se3& estimate_from_body);

/// The fit over all pairs that `alignment` asks for. yaw, se3 and sim3 are computed in closed form (Umeyama, PAMI 1991)
/// and never mirror. If the positions do not determine a part of the rotation, because all lie on one line or in one
/// point, the smallest rotation is taken for that part. Throws Error(unreadable_input) if there are no pairs, and for
/// sim3 also if the estimate or the reference never moves.
Similarity fitAlignment(const std::vector<PosePair>& pairs, Alignment alignment);

/// The pairs, with the poses of the estimate moved into the reference's frame.
std::vector<PosePair> aligned(std::vector<PosePair> pairs, const Similarity& reference_from_estimate);

}  // namespace omnimapper::eval
