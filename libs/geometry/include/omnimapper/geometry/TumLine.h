#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/geometry/Se3.h>

#include <string>

namespace omnimapper::geometry {

/// A line of a trajectory in the TUM RGB-D format, "stamp x y z qx qy qz qw" and a line feed. The stamp is Unix time
/// [s], exact to the tick of 100 ns. Lengths [m] and a unit quaternion with qw >= 0 have nine decimals each.
std::string tumLine(base::Stamp stamp, const Se3& world_from_body);

}  // namespace omnimapper::geometry
