#include "Tum.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/map/Trajectory.h>

#include "Numbers.h"

namespace omnimapper::plugins {

std::string encodeTum(const std::vector<map::StampedPose>& trajectory) {
  std::string out;
  for (const map::StampedPose& pose : trajectory) {
    const geometry::Se3 map_from_base = geometry::fromMrpt(pose.map_from_base);
    const double sign = map_from_base.rotation.w() < 0 ? -1 : 1;
    out += base::formatUnix(pose.stamp, 7);
    for (const double value : map_from_base.translation) out += " " + fixed(value, 6);
    // Eigen stores x y z w, the order of the format.
    for (const double value : map_from_base.rotation.coeffs()) out += " " + fixed(sign * value, 9);
    out += "\n";
  }
  return out;
}

}  // namespace omnimapper::plugins
