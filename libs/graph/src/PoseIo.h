#pragma once

#include <omnimapper/geometry/Se3.h>

#include "omnimapper/graph/ByteIo.h"

namespace omnimapper::graph {

/// x y yaw.
inline void writePose(std::ostream& out, const geometry::Se2& pose) {
  for (const double number : {pose.x, pose.y, pose.yaw}) writeDouble(out, number);
}

/// x y z qx qy qz qw.
inline void writePose(std::ostream& out, const geometry::Se3& pose) {
  for (const double number : pose.translation) writeDouble(out, number);
  for (const double number : pose.rotation.coeffs()) writeDouble(out, number);
}

inline geometry::Se2 readSe2(std::istream& in) {
  geometry::Se2 pose;
  for (double* number : {&pose.x, &pose.y, &pose.yaw}) *number = readDouble(in);
  return pose;
}

inline geometry::Se3 readSe3(std::istream& in) {
  geometry::Se3 pose;
  for (int i = 0; i < 3; ++i) pose.translation[i] = readDouble(in);
  for (int i = 0; i < 4; ++i) pose.rotation.coeffs()[i] = readDouble(in);
  return pose;
}

}  // namespace omnimapper::graph
