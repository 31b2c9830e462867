#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/camera/ColourImage.h>
#include <omnimapper/camera/DepthImage.h>
#include <omnimapper/camera/DepthNoise.h>
#include <omnimapper/perception/EdgeImage.h>

namespace omnimapper::perception {

struct EdgeOptions {
  double noise_at_1m = camera::DepthNoise().sigma;             ///< [m]
  double step_at_1m = camera::DepthNoise().step;               ///< [m]
  double correlation_area = camera::DepthNoise().correlation;  ///< [px^2]
  double min_depth = 0.2;                                      ///< [m]
  double max_depth = 12;                                       ///< [m]
  bool jumps = true;       ///< whether to look for occluding, occluded and boundary edges
  double jump_sigmas = 3;  ///< smallest depth discontinuity, in standard deviations of the difference of two pixels
  double relative_jump = 0.03;  ///< smallest depth discontinuity, relative to the depth (thesis: tau_dd)
  int max_hole = 50;            ///< [px] holes up to this width are bridged along rows and columns
  bool high_curvature = true;   ///< whether to look for high curvature edges
  /// [rad] Smallest angle between the two sides of a high curvature edge.
  double min_turn = 25 * base::option_text::kRadiansPerDegree;
  double turn_sigmas = 2;   ///< smallest angle of such an edge in standard deviations of the angle between two normals
  int window_radius = 4;    ///< [px] radius of the square window from which a normal is estimated
  int min_turn_pixels = 8;  ///< high curvature edges with fewer pixels are dropped
  bool rgb = true;          ///< whether to look for edges in the picture, if there is one
  double rgb_low = 40;    ///< edges continue above this gradient, |gx| + |gy| of Sobel's 3 x 3 operators on 8-bit grey
  double rgb_high = 100;  ///< edges start above this gradient

  camera::DepthNoise noise() const { return {noise_at_1m, step_at_1m, 0, correlation_area}; }
  static const base::OptionTable<EdgeOptions>& table();
};

/// Finds the five kinds of edges of thesis 3.1 in a depth image and the picture of the same view.
/// - Occluding and occluded: the near and the far side of a depth discontinuity. A discontinuity lies between two
///   8-connected neighbours, or between the pixels on both sides of a hole in a row or column. Their depths must differ
///   by more than the noise and `relative_jump` allow, and by more than the noise even if the surface on either side is
///   continued to the other pixel. A surface that is merely oblique therefore has no discontinuity.
/// - Boundary: a pixel beside a hole, unless the pixel is on a depth discontinuity. In each direction in which the
///   pixel touches a hole, the hole must be longer than `max_hole` or reach the image's border. The image's border
///   alone is no boundary edge.
/// - High curvature: the normals of neighbours on one surface differ by more than `min_turn` and by more than the noise
///   explains. Pixels without normals between such neighbours are skipped.
/// - RGB: Canny's edges of the picture where there is depth. J. Canny: A computational approach to edge detection, PAMI
///   8(6), 1986.
/// Depth discontinuities and noise are computed in inverse depth, where a plane is linear and the noise is the same
/// everywhere. The result has the same bits on every x86-64, with AVX2 and without.
class EdgeDetector {
 public:
  /// Throws Error(out_of_range) for min_depth >= max_depth or rgb_low > rgb_high.
  explicit EdgeDetector(const EdgeOptions& options);

  /// Finds the kinds of edges that the options ask for, except RGB. Both overloads are thread-safe.
  EdgeImage detect(const camera::DepthImage& image) const;
  /// Finds RGB edges, too. Throws Error(unreadable_input) if the picture does not have the size of the depth image.
  EdgeImage detect(const camera::DepthImage& image, const camera::ColourImage& colour) const;

 private:
  EdgeOptions options_;
};

}  // namespace omnimapper::perception
