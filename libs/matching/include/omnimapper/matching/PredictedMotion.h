#pragma once

#include <omnimapper/geometry/Se3.h>

namespace omnimapper::matching {

/// The motion of a camera since the last tracked image, as wheels or a gyroscope measured it, in optical frames.
struct PredictedMotion {
  geometry::Se3 last_from_camera;
  geometry::Matrix6d covariance;  ///< in the camera's frame now, tangent as in geometry::Se3
  /// Only a gyroscope measured it: the translation is zero, with the covariance of a hand-held camera of which nothing
  /// is known.
  bool only_turn = false;
};

}  // namespace omnimapper::matching
