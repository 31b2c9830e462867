#pragma once

#include <omnimapper/geometry/Se3.h>

namespace omnimapper::motion {

/// The motion of a camera since the last tracked image, as wheels or a gyroscope measured it, in optical frames.
struct PredictedMotion {
  geometry::Se3 last_from_camera;
  geometry::Matrix6d covariance;  ///< in the camera's frame now, tangent as in geometry::Se3
  /// True if only a gyroscope measured the motion. The translation is then that of a base that only turns, with a
  /// covariance as large as for a hand-held camera of unknown motion.
  bool only_turn = false;
};

}  // namespace omnimapper::motion
