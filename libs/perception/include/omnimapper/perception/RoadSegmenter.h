#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/camera/DepthImage.h>
#include <omnimapper/camera/DepthNoise.h>
#include <omnimapper/perception/PlaneRegion.h>

namespace omnimapper::perception {

/// The default noise is that of a stereo camera whose focal length times baseline is 60 px m, with a quarter of a pixel
/// of noise and steps of 1/16 px in disparity.
struct RoadOptions {
  double noise_at_1m = 0.0042;                      ///< [m]
  double step_at_1m = 0.001;                        ///< [m]
  double correlation_area = 16;                     ///< [px^2]
  double scale_sigma = camera::DepthNoise().scale;  ///< [-]
  double min_depth = 0.4;                           ///< [m]
  double max_depth = 20;                            ///< [m]
  int window_radius = 7;  ///< [px] radius of the square window from which a normal is estimated
  /// [rad] Largest angle between a pixel's normal and the normal of the expected ground.
  double max_tilt = 25 * base::option_text::kRadiansPerDegree;
  /// [rad] Largest angle between the normals of neighbours.
  double max_turn = 8 * base::option_text::kRadiansPerDegree;
  double max_off = 0.3;  ///< [m] largest distance from the expected ground, near the sensor
  double max_slope = 4 * base::option_text::kRadiansPerDegree;  ///< [rad] angle at which max_off widens with the depth
  double grow_sigmas = 4.5;   ///< largest distance of added pixels from the ground around them, in standard deviations
  double step_sigmas = 9;     ///< larger steps in height, such as kerbs, are not ground; in standard deviations
  int min_pixels = 200;       ///< least number of pixels of a piece of ground
  int min_hole_pixels = 100;  ///< smaller holes are not outlined

  camera::DepthNoise noise() const { return {noise_at_1m, step_at_1m, 0, correlation_area, scale_sigma}; }
  static const base::OptionTable<RoadOptions>& table();
};

struct RoadSegmentation {
  PlaneSegmentation ground;  ///< connected pieces, each with the plane that fits it best; the largest first
  /// For each pixel of the image, row by row: 1 if the pixel is ground that the first pass found by the pixel's own
  /// normal, else 0.
  std::vector<std::uint8_t> sure;
};

/// Finds the ground that can be driven on, which need not be flat (thesis 3.4.7): connected parts of the image that are
/// near the ground expected from the sensor's pose, and whose normals are near that ground's normal and change
/// smoothly. The normals of stereo cameras are noisy and have holes. A second pass therefore adds pixels that lie on
/// planes fitted to the ground around them. It does not add pixels whose surroundings are on average above this ground,
/// nor objects that, according to their normals, stand on the ground, nor the feet of these objects. It also removes
/// steps between two heights of the ground, such as the sides of kerbs.
class RoadSegmenter {
 public:
  /// Throws Error(out_of_range) for min_depth >= max_depth.
  explicit RoadSegmenter(const RoadOptions& options);

  /// `expected`: the ground that the wheels stand on, in the camera's optical frame (x right, y down, z forward), with
  /// the normal up. Thread-safe; the same bits on every x86-64.
  RoadSegmentation segment(const camera::DepthImage& image, const geometry::Plane3& expected) const;

 private:
  RoadOptions options_;
};

}  // namespace omnimapper::perception
