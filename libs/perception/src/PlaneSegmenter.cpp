#include <omnimapper/base/Error.h>
#include <omnimapper/perception/PlaneSegmenter.h>

#include <algorithm>
#include <tuple>

#include "DepthSensor.h"
#include "planes/Description.h"
#include "planes/LabelledPlanes.h"

namespace omnimapper::perception {

const base::OptionTable<PlaneOptions>& PlaneOptions::table() {
  using base::Range;
  static const auto table =
      depthSensorTable<PlaneOptions>()
          .number("distortion_at_1m_m", &PlaneOptions::distortion_at_1m, Range::notNegative(),
                  "Largest distortion that the sensor makes in a flat wall at a distance of 1 m; it grows with the "
                  "square of the distance. Covariances count half of it as a standard deviation.")
          .number("scale_sigma", &PlaneOptions::scale_sigma, {0, 1}, kScaleHelp)
          .integer("min_pixels", &PlaneOptions::min_pixels, {1, 1e9}, "Planes with fewer pixels are left out.")
          .integer("min_hole_pixels", &PlaneOptions::min_hole_pixels, {1, 1e9},
                   "Holes in a plane that have fewer pixels than this are not outlined.");
  return table;
}

bool PlaneOptions::operator==(const PlaneOptions& other) const {
  const auto values = [](const PlaneOptions& o) {
    return std::tie(o.noise_at_1m, o.step_at_1m, o.distortion_at_1m, o.correlation_area, o.scale_sigma, o.min_depth,
                    o.max_depth, o.min_pixels, o.min_hole_pixels);
  };
  return values(*this) == values(other);
}

namespace {

// Pads the rows of `from` to a length of `stride`.
std::vector<obs::Rgb> widened(const std::vector<obs::Rgb>& from, int width, int height, int stride) {
  std::vector<obs::Rgb> to(static_cast<std::size_t>(stride) * static_cast<std::size_t>(height));
  for (std::ptrdiff_t y = 0; y < height; ++y)
    std::copy(from.begin() + y * width, from.begin() + (y + 1) * width, to.begin() + y * stride);
  return to;
}

}  // namespace

PlaneSegmenter::PlaneSegmenter(const PlaneOptions& options, const PlaneComparisonOptions& comparison)
    : options_(options), comparison_(comparison) {
  refuseDepths("planes", options);
}

PlaneSegmentation PlaneSegmenter::segment(const camera::DepthImage& image, const std::vector<obs::Rgb>& colours) const {
  const int width = image.width(), height = image.height();
  if (width == 0 || height == 0) return {width, height, {}, {}};
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (needsColours() && colours.size() != pixels) {
    throw base::Error(base::ExitCode::unreadable_input, "the comparator of planes needs a colour for each of " +
                                                            std::to_string(pixels) + " pixels, but there are " +
                                                            std::to_string(colours.size()) + " colours");
  }
  const planes::InverseDepth inverse = planes::invert(image, options_.min_depth, options_.max_depth);
  planes::LabelledPlanes found = comparison_.comparison->find(image, inverse, options_);
  PlanePixels labelled{found.labels.stride, found.labels.rows, found.labels.values.data(), colours.data()};
  std::vector<obs::Rgb> padded;
  if (needsColours() && labelled.width != width) {
    padded = widened(colours, width, height, labelled.width);
    labelled.colours = padded.data();
  }
  const Components components = comparison_.comparison->connect(labelled, comparison_);
  // A comparison that only requires the same plane drops no pixel, so that there is nothing to clear.
  if (comparison_.comparison->connect != kSamePlane.connect) planes::clearOthers(components, found.labels);
  return planes::describe(inverse, image.camera(), options_.noise(), found.regions, std::move(found.labels), components,
                          {options_.min_pixels, options_.min_hole_pixels, options_.max_depth});
}

}  // namespace omnimapper::perception
