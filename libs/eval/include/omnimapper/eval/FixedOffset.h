#pragma once

#include <omnimapper/eval/Trajectory.h>

#include <string>

namespace omnimapper::eval {

/// What a trajectory and a reference may differ by without any error: the reference may be of another part of the same
/// rigid body, by another clock.
struct FixedOffset {
  geometry::Se3 body_from_part;  ///< pose of the reference's part on the estimate's body
  double clock = 0;              ///< [s] to add to the estimate's stamps to have those of the reference
};

/// The offset with the least squares of position errors [m] and of rotation errors [rad] times 0.3 m, together with the
/// motion between the two worlds. Parts of the offset that the motion does not determine, such as the height on a level
/// floor, stay zero. The reference is interpolated over gaps of up to `longest_gap`. Throws Error(unreadable_input) if
/// fewer than ten poses of the estimate lie within the reference.
FixedOffset fitFixedOffset(const Trajectory& estimate, const Trajectory& reference, base::Duration longest_gap);

/// The trajectory of the reference's part by the reference's clock.
Trajectory withOffset(const Trajectory& estimate, const FixedOffset& offset);

/// One line for the user.
std::string describe(const FixedOffset& offset);

}  // namespace omnimapper::eval
