#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/perception/ColourImage.h>
#include <omnimapper/perception/DepthImage.h>
#include <omnimapper/perception/DepthNoise.h>
#include <omnimapper/perception/EdgeImage.h>

namespace omnimapper::perception {

struct EdgeOptions {
  double noise_at_1m = DepthNoise().sigma;             ///< [m]
  double step_at_1m = DepthNoise().step;               ///< [m]
  double correlation_area = DepthNoise().correlation;  ///< [px^2]
  double min_depth = 0.2;                              ///< [m]
  double max_depth = 12;                               ///< [m]
  bool jumps = true;                                   ///< whether to look for occluding, occluded and boundary edges
  double jump_sigmas = 3;       ///< least jump in depth, in standard deviations of a difference of pixels
  double relative_jump = 0.03;  ///< least jump in depth, in parts of the depth (thesis: tau_dd)
  int max_hole = 50;            ///< [px] holes up to so wide are bridged along rows and columns
  bool high_curvature = true;   ///< whether to look for them
  double min_turn = 25 * base::option_text::kRadiansPerDegree;  ///< [rad] least angle between two sides of an edge
  double turn_sigmas = 2;   ///< the same, in standard deviations of the angle between two normals
  int window_radius = 4;    ///< [px] of the windows of normals
  int min_turn_pixels = 8;  ///< shorter edges of high curvature are dropped
  bool rgb = true;          ///< whether to look for them, where there is a picture
  double rgb_low = 40;    ///< of the gradient, |gx| + |gy| of Sobel's 3 x 3 operators on 8-bit grey: edges go on above
  double rgb_high = 100;  ///< edges begin above

  DepthNoise noise() const { return {noise_at_1m, step_at_1m, 0, correlation_area}; }
  static const base::OptionTable<EdgeOptions>& table();
};

/// Finds the five kinds of edges of thesis 3.1 in a depth image and the picture of the same view.
/// - A jump: two of 8-connected neighbours, or the pixels on both sides of a hole of a row or column, differ by more
///   than the noise and `relative_jump` allow, and do so too if the surface on either side is continued to the other:
///   what is merely aslant does not jump. Their near one is occluding, the far one occluded.
/// - Boundary: a pixel beside a hole that is open (longer than `max_hole`, or reaching the image's border) in each
///   direction in which it touches it, and which is on no jump. The image's border alone is none.
/// - High curvature: the normals of neighbours on one surface, with pixels that have none between them left out, turn
/// by
///   more than `min_turn` and what the noise makes of it.
/// - RGB: Canny's edges of the picture where there is depth. J. Canny: A computational approach to edge detection, PAMI
///   8(6), 1986.
/// Jumps and noise are reckoned in inverse depth, where a plane is linear and the noise is the same everywhere. The
/// same bits on every x86-64, with AVX2 and without.
class EdgeDetector {
 public:
  /// Throws Error(out_of_range) for min_depth >= max_depth or rgb_low > rgb_high.
  explicit EdgeDetector(const EdgeOptions& options);

  /// All kinds but RGB, of those that the options want. Thread-safe, as the other is.
  EdgeImage detect(const DepthImage& image) const;
  /// Throws Error(unreadable_input) if the picture is not of the depth image's size.
  EdgeImage detect(const DepthImage& image, const ColourImage& colour) const;

 private:
  EdgeOptions options_;
};

}  // namespace omnimapper::perception
