#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/perception/DepthImage.h>
#include <omnimapper/perception/DepthNoise.h>
#include <omnimapper/perception/PlaneRegion.h>

namespace omnimapper::perception {

/// The defaults of the noise are those of a stereo camera with 60 px m of focal length times baseline, a quarter of a
/// pixel of noise and steps of 1/16 px.
struct RoadOptions {
  double noise_at_1m = 0.0042;                                  ///< [m]
  double step_at_1m = 0.001;                                    ///< [m]
  double correlation_area = 16;                                 ///< [px^2]
  double scale_sigma = DepthNoise().scale;                      ///< [-]
  double min_depth = 0.4;                                       ///< [m]
  double max_depth = 20;                                        ///< [m]
  int window_radius = 7;                                        ///< [px] of the windows of normals
  double max_tilt = 25 * base::option_text::kRadiansPerDegree;  ///< [rad] of the ground from the expected one
  double max_turn = 8 * base::option_text::kRadiansPerDegree;   ///< [rad] from one pixel to the next
  double max_off = 0.3;                                         ///< [m] of the ground from the expected one
  double max_slope = 4 * base::option_text::kRadiansPerDegree;  ///< [rad] by which that grows with the depth
  double grow_sigmas = 4.5;  ///< deviations from the ground around it within which a pixel without its normal is ground
  double step_sigmas = 9;    ///< deviations of a step in height, such as a kerb, that is no ground
  int min_pixels = 200;      ///< of a piece of ground
  int min_hole_pixels = 100;  ///< smaller holes are not outlined

  DepthNoise noise() const { return {noise_at_1m, step_at_1m, 0, correlation_area, scale_sigma}; }
  static const base::OptionTable<RoadOptions>& table();
};

struct RoadSegmentation {
  PlaneSegmentation ground;  ///< its connected pieces, with the planes that fit them best; the largest first
  /// Of each pixel, row by row: 1 where its own normal says that it is ground, before the second pass; else 0. Of the
  /// size of the image, 1 pixel or none too.
  std::vector<std::uint8_t> sure;
};

/// Finds the ground that can be driven on, which need not be flat (thesis 3.4.7): connected parts of the image whose
/// normals are near that of the ground expected from the sensor's pose and change smoothly, and which are near it
/// themselves. Stereo's normals are noisy and have holes: a second pass adds the pixels that lie on the ground around
/// them, by planes fitted to what was found, but for what is above it on average over a window, and for what stands on
/// it, as normals tell, and its foot; and takes away the steps between two heights of it, such as the sides of kerbs.
class RoadSegmenter {
 public:
  /// Throws Error(out_of_range) for min_depth >= max_depth.
  explicit RoadSegmenter(const RoadOptions& options);

  /// `expected`: the ground that the wheels stand on, in the camera's optical frame (x right, y down, z forward),
  /// normal up. Thread-safe; the same bits on every x86-64.
  RoadSegmentation segment(const DepthImage& image, const geometry::Plane3& expected) const;

 private:
  RoadOptions options_;
};

}  // namespace omnimapper::perception
