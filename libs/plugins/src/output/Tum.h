#pragma once

#include <omnimapper/map/Trajectory.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// Lines "stamp x y z qx qy qz qw": Unix time [s] to the tick of 100 ns, lengths [m], unit quaternion with qw >= 0.
std::string encodeTum(const std::vector<map::StampedPose>& trajectory);

}  // namespace omnimapper::plugins
