#include <omnimapper/base/Error.h>
#include <omnimapper/perception/PlaneSegmenter.h>

#include "planes/CellRegions.h"
#include "planes/Description.h"
#include "planes/PixelLabels.h"
#include "planes/SmallRegions.h"

namespace omnimapper::perception {

const base::OptionTable<PlaneOptions>& PlaneOptions::table() {
  using base::Range;
  static const auto table =
      base::OptionTable<PlaneOptions>()
          .number("noise_at_1m_m", &PlaneOptions::noise_at_1m, Range::positive(),
                  "Standard deviation of a pixel's depth at 1 m; it grows with the square of the depth.")
          .number("step_at_1m_m", &PlaneOptions::step_at_1m, Range::notNegative(),
                  "Step between two depths that the sensor can tell apart at 1 m; 0 if it has none.")
          .number("bend_at_1m_m", &PlaneOptions::bend_at_1m, Range::notNegative(),
                  "By how much the sensor may show a flat wall bent, at 1 m.")
          .number("correlation_area_px2", &PlaneOptions::correlation_area, {1, 10000},
                  "How many neighbouring pixels share one error.")
          .number("min_depth_m", &PlaneOptions::min_depth, Range::positive(), "Nearer pixels are left out.")
          .number("max_depth_m", &PlaneOptions::max_depth, Range::positive(), "Farther pixels are left out.")
          .integer("min_pixels", &PlaneOptions::min_pixels, {1, 1e9}, "Planes with fewer pixels are left out.")
          .integer("min_hole_pixels", &PlaneOptions::min_hole_pixels, {1, 1e9},
                   "Holes with fewer pixels are not outlined.");
  return table;
}

PlaneSegmenter::PlaneSegmenter(const PlaneOptions& options) : options_(options) {
  if (!(options.min_depth < options.max_depth)) {
    throw base::Error(base::ExitCode::out_of_range,
                      "planes: min_depth_m = " + std::to_string(options.min_depth) + " is not below max_depth_m = " +
                          std::to_string(options.max_depth) + "; make the span from one to the other the sensor's");
  }
}

PlaneSegmentation PlaneSegmenter::segment(const DepthImage& image) const {
  using namespace planes;
  if (image.width() == 0 || image.height() == 0) return {image.width(), image.height(), {}, {}};

  const DepthNoise noise = options_.noise();
  const Pinhole& camera = image.camera();
  const InverseDepth inverse = invert(image, options_.min_depth, options_.max_depth);
  const CellGrid grid = fitCells(inverse, camera, noise);
  const CellRegions merged = mergeRegions(grid, noise, growRegions(grid, noise));
  const CellRegions regions = dropExplained(inverse, camera, noise, grid, merged);
  PixelLabels labels = labelPixels(inverse, camera, noise, grid, regions);
  return describe(inverse, camera, noise, regions, std::move(labels),
                  {options_.min_pixels, options_.min_hole_pixels, options_.max_depth});
}

}  // namespace omnimapper::perception
