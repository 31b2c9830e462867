#include <omnimapper/base/Error.h>
#include <omnimapper/perception/EdgeDetector.h>
#include <omnimapper/perception/Normals.h>

#include <cmath>
#include <string>

#include "DepthSensor.h"
#include "edges/Canny.h"
#include "edges/CurvatureEdges.h"
#include "edges/DepthDiscontinuities.h"

namespace omnimapper::perception {

const base::OptionTable<EdgeOptions>& EdgeOptions::table() {
  using base::Range;
  static const auto table =
      depthSensorTable<EdgeOptions>()
          .flag("jumps", &EdgeOptions::jumps,
                "Detects edges at depth discontinuities (occluding on their near side, occluded on their far side) and "
                "beside holes of the depth image (boundary).")
          .number("jump_sigmas", &EdgeOptions::jump_sigmas, Range::positive(),
                  "Smallest depth discontinuity that is an occluding edge, in standard deviations of the difference "
                  "between two pixels. The discontinuity must exceed relative_jump, too.")
          .number("relative_jump", &EdgeOptions::relative_jump, {0, 1},
                  "Smallest depth discontinuity that is an occluding edge, relative to the depth (thesis: tau_dd). The "
                  "discontinuity must exceed jump_sigmas, too.")
          .integer("max_hole_px", &EdgeOptions::max_hole, {0, 4096},
                   "Holes in the depth image up to this width are bridged. Pixels beside wider holes are "
                   "boundary edges.")
          .flag("high_curvature", &EdgeOptions::high_curvature,
                "Detects high curvature edges, where neighbouring surfaces meet at an angle.")
          .number("min_turn_deg", &EdgeOptions::min_turn, {1, 180},
                  "Smallest angle between the surfaces on the two sides of a high curvature edge.")
          .number("turn_sigmas", &EdgeOptions::turn_sigmas, Range::notNegative(),
                  "Smallest angle between the surfaces on the two sides of a high curvature edge, in standard "
                  "deviations of the angle between two normals.")
          .integer("window_radius_px", &EdgeOptions::window_radius, {1, 7},
                   "Radius r of the square window around a pixel from which the pixel's normal is estimated. The "
                   "window has 2 r + 1 pixels a side.")
          .integer("min_turn_pixels", &EdgeOptions::min_turn_pixels, {1, 1000000},
                   "High curvature edges with fewer pixels than this are left out.")
          .flag("rgb", &EdgeOptions::rgb, "Detects edges in the picture.")
          .number("rgb_low", &EdgeOptions::rgb_low, {0, 2040},
                  "Lower threshold of the Canny edge detector: an edge of the picture continues where the gradient is "
                  "above this value.")
          .number("rgb_high", &EdgeOptions::rgb_high, {0, 2040},
                  "Upper threshold of the Canny edge detector: an edge of the picture starts where the gradient is "
                  "above this value.");
  return table;
}

EdgeDetector::EdgeDetector(const EdgeOptions& options) : options_(options) {
  using base::option_text::format;
  if (options.min_depth >= options.max_depth) {
    throw base::Error(base::ExitCode::out_of_range, "min_depth_m = " + format(options.min_depth) +
                                                        ": must be below max_depth_m = " + format(options.max_depth));
  }
  if (options.rgb_low > options.rgb_high) {
    throw base::Error(base::ExitCode::out_of_range, "rgb_low = " + format(options.rgb_low) +
                                                        ": must not be above rgb_high = " + format(options.rgb_high));
  }
}

namespace {

EdgeImage unmarked(const camera::DepthImage& image) {
  EdgeImage edges{image.width(), image.height(), {}};
  edges.labels.resize(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  return edges;
}

// Standard deviation of the angle between two normals at 1 m [rad]; it grows with the depth. The slope of a plane
// fitted to a window of n = 2 r + 1 pixels a side has the variance 3 sigma^2 / (n^2 r (r + 1)); a pixel is 1 / f wide.
double angleSigma(const camera::DepthImage& image, const EdgeOptions& options) {
  const double r = options.window_radius, n = 2 * r + 1;
  const double slope = std::sqrt(3 * options.noise().meanVariance() / (n * n * r * (r + 1)));
  return std::sqrt(2.0) * slope * std::max(std::abs(image.camera().fx), std::abs(image.camera().fy));
}

void markHighCurvature(const planes::InverseDepth& inverse, const camera::DepthImage& image, const EdgeOptions& options,
                       EdgeImage& edges) {
  const NormalImage normals = NormalEstimator(normalsBy(options, options.window_radius)).estimate(image);
  edges::labelCurvatureEdges(inverse, image.camera(), normals,
                             {options.min_turn, options.turn_sigmas * angleSigma(image, options),
                              2 * options.window_radius, options.min_turn_pixels},
                             edges.labels.data());
}

void markRgb(const planes::InverseDepth& inverse, edges::Candidates found, EdgeImage& edges) {
  std::uint8_t* to = edges.labels.data();
  for (int y = 0; y < edges.height; ++y, to += edges.width) {
    const std::uint8_t* from = found.row(y);
    const float* q = inverse.at(0, y);
    for (int x = 0; x < edges.width; ++x) {
      const bool marked = from[x] == edges::Candidates::kKept && q[x] > 0;
      to[x] = static_cast<std::uint8_t>(to[x] | (marked ? kRgb : 0));
    }
  }
}

EdgeImage geometricEdges(const planes::InverseDepth& inverse, const camera::DepthImage& image,
                         const EdgeOptions& options) {
  EdgeImage edges = unmarked(image);
  if (options.jumps) {
    const double of_difference = std::sqrt(2 * options.noise().pixelVariance());
    edges::labelDepthDiscontinuities(inverse,
                                     {static_cast<float>(options.jump_sigmas * of_difference),
                                      static_cast<float>(options.relative_jump), options.max_hole},
                                     edges.labels.data());
  }
  if (options.high_curvature && !edges.labels.empty()) markHighCurvature(inverse, image, options, edges);
  return edges;
}

}  // namespace

EdgeImage EdgeDetector::detect(const camera::DepthImage& image) const {
  return geometricEdges(planes::invert(image, options_.min_depth, options_.max_depth), image, options_);
}

EdgeImage EdgeDetector::detect(const camera::DepthImage& image, const camera::ColourImage& colour) const {
  if (colour.width != image.width() || colour.height != image.height()) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "the picture has " + std::to_string(colour.width) + " x " + std::to_string(colour.height) +
                          " pixels, the depth image " + std::to_string(image.width()) + " x " +
                          std::to_string(image.height()));
  }
  const planes::InverseDepth inverse = planes::invert(image, options_.min_depth, options_.max_depth);
  EdgeImage edges = geometricEdges(inverse, image, options_);
  if (options_.rgb) {
    markRgb(inverse, edges::canny(colour, static_cast<int>(options_.rgb_low), static_cast<int>(options_.rgb_high)),
            edges);
  }
  return edges;
}

}  // namespace omnimapper::perception
