#pragma once

#include <omnimapper/matching/DenseMatcher.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::matching {

/// Number of points that are processed side by side.
constexpr int kLanes = 8;
using Lanes = Eigen::Array<float, kLanes, 1>;

constexpr float kNoGrey = -1;

/// Eight points of a reference, in its optical frame [m].
struct DensePoints {
  Lanes x, y, z;
  Lanes nx, ny, nz;  ///< unit normal towards the camera; 0 where none is known
  Lanes gx, gy, gz;  ///< gradient of brightness by the point's position [1/m]; 0 where it is not used
  Lanes grey;        ///< 0 to 255, or kNoGrey
  Lanes is_point;    ///< 1, or 0 for the padding of the last eight
};

struct DenseReferenceLevel {
  std::vector<DensePoints> points;
  std::size_t count = 0;  ///< of points
  /// Orthonormal columns: motions that the planes of the points leave open, three for a bare wall. The noise of the
  /// normals would seem to constrain them.
  Eigen::Matrix<double, 6, Eigen::Dynamic> open;
};

class DenseReference {
 public:
  std::vector<DenseReferenceLevel> levels;  ///< by pyramid level; empty ones are not matched
  bool has_picture = false;
};

}  // namespace omnimapper::matching
