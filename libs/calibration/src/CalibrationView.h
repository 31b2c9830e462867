#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/geometry/Se3.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace omnimapper::calibration {

/// A plane that is fitted around a pixel of a depth image; its inverse depth is linear in the pixel.
struct LocalPlane {
  Eigen::Vector2d pixel;  ///< middle of the fit
  double inverse_depth;   ///< [1/m] at that pixel, in the scale of the log's depths
  Eigen::Vector2d slope;  ///< [1/m/px]
  double sigma;           ///< [1/m]
  double at(const Eigen::Vector2d& p) const { return inverse_depth + slope.dot(p - pixel); }
};

/// One image of the log with its depths, both with lens distortion.
struct CalibrationView {
  base::Stamp stamp;
  int stretch = 0;  ///< number of the stretch of uninterrupted tracking that it is in
  geometry::Vector6d velocity = geometry::Vector6d::Zero();  ///< [m/s] [rad/s] at its stamp, in the picture's frame
  double turn_rate = 0;                                      ///< [rad/s] while it was taken
  geometry::Se3 world_from_picture;                          ///< of the optical frame; initial value
  geometry::Se3 base_from_picture;                           ///< from the log
  int width = 0, height = 0;                                 ///< of the picture
  std::vector<std::uint8_t> grey;                            ///< the picture
  int depth_width = 0, depth_height = 0;
  std::vector<float> inverse_depth;  ///< [1/m]; 0 where nothing was measured

  /// The plane around a pixel of the depth image. None at edges, at the rim of the image, and where fewer than half of
  /// the pixels around it have a depth.
  std::optional<LocalPlane> planeAt(const Eigen::Vector2d& depth_pixel) const;
};

}  // namespace omnimapper::calibration
