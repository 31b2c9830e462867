#pragma once

#include <omnimapper/geometry/Se3.h>

namespace omnimapper::matching {

/// The motion of a camera since the image that was tracked before, as wheels or a gyroscope tell it: optical frames.
struct PredictedMotion {
  geometry::Se3 last_from_camera;
  geometry::Matrix6d covariance;  ///< in the camera's frame now, tangent as in geometry::Se3
  /// A gyroscope told it: the translation is none, and its covariance that of a hand of which nothing is known.
  bool only_turn = false;
};

}  // namespace omnimapper::matching
