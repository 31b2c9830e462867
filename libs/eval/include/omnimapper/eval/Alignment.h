#pragma once

#include <omnimapper/eval/PosePairs.h>

#include <Eigen/Core>
#include <string>

namespace omnimapper::eval {

/// Which part of an estimate's frame is fitted to the reference before the estimate is judged.
enum class Alignment {
  none,   ///< nothing: both are in the same frame
  first,  ///< the motion with which the first pair agrees exactly
  yaw,    ///< translation and turn about z, least squares over positions: frames that share the vertical
  se3,    ///< translation and rotation, least squares over positions
  sim3,   ///< the same and scale
};

/// The alignment with a name as above. Throws Error(command_line) that lists the names.
Alignment alignmentNamed(const std::string& name);

/// reference_from_estimate: p_in_reference = scale * R p_in_estimate + t; orientations turn by R.
struct Similarity {
  double scale = 1;
  geometry::Se3 motion;  ///< R and t
};

Eigen::Vector3d operator*(const Similarity& reference_from_estimate, const Eigen::Vector3d& p_in_estimate);
geometry::Se3 operator*(const Similarity& reference_from_estimate, const geometry::Se3& estimate_from_body);

/// The fit over all pairs that `alignment` asks for.
/// yaw, se3 and sim3 are the closed form of Umeyama, PAMI 1991, which never mirrors. If the positions do not determine
/// a part of the rotation (all on one line or in one point), the smallest rotation is taken for that part. Throws
/// Error(unreadable_input) without pairs, and for sim3 if the estimate never moves.
Similarity fitAlignment(const std::vector<PosePair>& pairs, Alignment alignment);

/// The pairs with their estimate moved into the reference's frame.
std::vector<PosePair> aligned(std::vector<PosePair> pairs, const Similarity& reference_from_estimate);

}  // namespace omnimapper::eval
