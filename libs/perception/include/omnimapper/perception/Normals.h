#pragma once

#include <omnimapper/camera/DepthImage.h>
#include <omnimapper/camera/DepthNoise.h>

#include <memory>

namespace omnimapper::perception {

struct NormalOptions {
  double noise_at_1m = camera::DepthNoise().sigma;  ///< [m]
  double step_at_1m = camera::DepthNoise().step;    ///< [m]
  double min_depth = 0.2;                           ///< [m]
  double max_depth = 12;                            ///< [m]
  int radius = 4;                                   ///< [px] 1 to 7; the square window has 2 radius + 1 pixels a side
};

/// Unit normals of an image's pixels, row by row. They point towards the sensor and are in its optical frame (x right,
/// y down, z forward). NaN where no normal could be determined.
struct NormalImage {
  int width = 0, height = 0;
  /// All x, then all y, then all z.
  std::unique_ptr<float[]> values;

  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  const float* x() const { return values.get(); }
  const float* y() const { return values.get() + size(); }
  const float* z() const { return values.get() + 2 * size(); }
};

/// Estimates the normal of each pixel from a plane that is fitted to the window around the pixel. The fit uses inverse
/// depths, for the reasons given at PlaneSegmenter. Where the window contains an edge or pixels that were not measured,
/// or reaches beyond the image's border, the pixel gets the normal of another pixel on whose plane it lies, at most 2
/// radius steps away. Images narrower than the window plus seven pixels have no normals.
class NormalEstimator {
 public:
  /// Throws Error(out_of_range) unless 0 < min_depth < max_depth, and for a radius out of 1 to 7, a noise that is not
  /// positive, or a negative step.
  explicit NormalEstimator(const NormalOptions& options);

  /// Thread-safe.
  NormalImage estimate(const camera::DepthImage& image) const;

 private:
  NormalOptions options_;
};

}  // namespace omnimapper::perception
