#pragma once

#include <omnimapper/perception/DepthImage.h>
#include <omnimapper/perception/DepthNoise.h>

#include <memory>

namespace omnimapper::perception {

struct NormalOptions {
  double noise_at_1m = DepthNoise().sigma;  ///< [m]
  double step_at_1m = DepthNoise().step;    ///< [m]
  double min_depth = 0.2;                   ///< [m]
  double max_depth = 12;                    ///< [m]
  int radius = 4;                           ///< [px] of the square window, of 2 radius + 1 pixels a side; 1 to 7
};

/// Unit normals in the order of an image's pixels, towards the sensor, in its optical frame; NaN where none could be
/// determined.
struct NormalImage {
  int width = 0, height = 0;
  /// All x, then all y, then all z.
  std::unique_ptr<float[]> values;

  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  const float* x() const { return values.get(); }
  const float* y() const { return values.get() + size(); }
  const float* z() const { return values.get() + 2 * size(); }
};

/// Estimates the normal of each pixel from the plane fitted to the window around it, in inverse depth for the reasons
/// given at PlaneSegmenter. Where the window reaches over an edge, over pixels that were not measured or over the
/// image's border, the normal is that of a neighbour on whose plane the pixel lies, up to 2 radius steps away. Images
/// narrower than the window plus seven pixels have no normals.
class NormalEstimator {
 public:
  /// Throws Error(out_of_range) for a radius out of 1 to 7, a noise that is not positive, a negative step, or depths
  /// that are not 0 < min_depth < max_depth.
  explicit NormalEstimator(const NormalOptions& options);

  /// Thread-safe.
  NormalImage estimate(const DepthImage& image) const;

 private:
  NormalOptions options_;
};

}  // namespace omnimapper::perception
