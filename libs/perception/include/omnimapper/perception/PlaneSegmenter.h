#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/camera/DepthImage.h>
#include <omnimapper/camera/DepthNoise.h>
#include <omnimapper/perception/Normals.h>
#include <omnimapper/perception/PlaneComparison.h>
#include <omnimapper/perception/PlaneRegion.h>

#include <vector>

namespace omnimapper::perception {

struct PlaneOptions {
  double noise_at_1m = camera::DepthNoise().sigma;             ///< [m]
  double step_at_1m = camera::DepthNoise().step;               ///< [m]
  double distortion_at_1m = camera::DepthNoise().distortion;   ///< [m]
  double correlation_area = camera::DepthNoise().correlation;  ///< [px^2]
  double scale_sigma = camera::DepthNoise().scale;             ///< [-]
  double min_depth = 0.2;                                      ///< [m]
  double max_depth = 12;                                       ///< [m]
  int min_pixels = 1000;                                       ///< least number of a plane's pixels
  int min_hole_pixels = 30;                                    ///< smaller holes are not outlined

  camera::DepthNoise noise() const {
    return {noise_at_1m, step_at_1m, distortion_at_1m, correlation_area, scale_sigma};
  }
  static const base::OptionTable<PlaneOptions>& table();
  bool operator==(const PlaneOptions& other) const;
};

/// Finds all planes of an organized depth image (thesis 3.4.3 and 3.4.4), accurate to a pixel. All computations use the
/// inverse depth 1/z. The inverse depth of a plane is linear in column u and row v, 1/z = a u + b v + c, and the noise
/// that triangulating sensors have in it is the same at all depths. A linear least squares fit of inverse depths is
/// therefore exact for planes, and each threshold is a single number for near and far planes. Cells of 16 x 16 pixels
/// are fitted and grown to regions, regions that one plane explains are merged, borders are decided pixel by pixel, and
/// the resulting regions are fitted again and outlined. A comparison may have further criteria than lying on one plane,
/// or find planes by another method. The result has the same bits on every x86-64, with AVX2 and without.
class PlaneSegmenter {
 public:
  /// Throws Error(out_of_range) for min_depth >= max_depth.
  explicit PlaneSegmenter(const PlaneOptions& options, const PlaneComparisonOptions& comparison = {});

  /// Thread-safe. For an image without planes, such as one without pixels, the result has no planes.
  PlaneSegmentation segment(const camera::DepthImage& image) const { return segment(image, {}); }
  /// `colours` has the colour of each pixel, row by row, black where it is not known. Throws Error(unreadable_input) if
  /// the comparison needs colours and there are not as many colours as pixels.
  PlaneSegmentation segment(const camera::DepthImage& image, const std::vector<obs::Rgb>& colours) const;
  bool needsColours() const { return comparison_.comparison->needs_colours; }

 private:
  PlaneOptions options_;
  PlaneComparisonOptions comparison_;
};

}  // namespace omnimapper::perception
