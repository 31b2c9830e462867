#pragma once

#include <omnimapper/geometry/Se3.h>

namespace omnimapper::geometry {

/// From the optical frame of a camera (x right in the image, y down, z forward) to the frame of a sensor at the same
/// place (x forward, y left, z up), as MRPT's range cameras have it.
inline Se3 sensorFromOptical() {
  Eigen::Matrix3d axes;
  axes << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return {Eigen::Quaterniond(axes), Eigen::Vector3d::Zero()};
}

}  // namespace omnimapper::geometry
