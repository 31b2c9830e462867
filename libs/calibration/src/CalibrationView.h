#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/geometry/Se3.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace omnimapper::calibration {

/// A surface around a pixel of a depth image: inverse depth is linear in the image of a plane.
struct LocalPlane {
  Eigen::Vector2d pixel;  ///< around which it was fitted
  double inverse_depth;   ///< [1/m] there, as the log tells depths
  Eigen::Vector2d slope;  ///< [1/m/px]
  double sigma;           ///< [1/m]
  double at(const Eigen::Vector2d& p) const { return inverse_depth + slope.dot(p - pixel); }
};

/// One image of the log with its depths, raw: the lens is in them.
struct CalibrationView {
  base::Stamp stamp;
  int stretch = 0;  ///< images between which the tracking did not begin anew have one number
  geometry::Vector6d velocity = geometry::Vector6d::Zero();  ///< [m/s] [rad/s] in the picture's frame, then
  double turn_rate = 0;                                      ///< [rad/s] while it was taken
  geometry::Se3 world_from_picture;                          ///< optical frame; the start
  geometry::Se3 base_from_picture;                           ///< as the log has it
  int width = 0, height = 0;                                 ///< of the picture
  std::vector<std::uint8_t> grey;                            ///< the picture
  int depth_width = 0, depth_height = 0;
  std::vector<float> inverse_depth;  ///< [1/m]; 0 where nothing was measured

  /// None at edges, at the rim, and where less than half of the pixels around have a depth.
  std::optional<LocalPlane> planeAt(const Eigen::Vector2d& depth_pixel) const;
};

}  // namespace omnimapper::calibration
