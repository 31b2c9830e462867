#include <omnimapper/base/Error.h>
#include <omnimapper/perception/PlaneSegmenter.h>

#include <algorithm>

#include "planes/CellRegions.h"
#include "planes/Outlines.h"
#include "planes/PixelLabels.h"
#include "planes/RegionFit.h"
#include "planes/SameLabel.h"
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

namespace {

// Labels of regions of cells become those of the result.
void relabel(const Components& components, const std::vector<planes::FittedRegion>& fitted,
             planes::PixelLabels& labels) {
  std::vector<std::uint16_t> of_component(components.pixels.size(), 0);
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    of_component[static_cast<std::size_t>(fitted[i].component)] = static_cast<std::uint16_t>(i + 1);
  }
  for (const PixelRun& run : components.runs) {
    const auto row = labels.values.begin() + static_cast<std::ptrdiff_t>(run.row) * labels.stride;
    std::fill(row + run.begin, row + run.end, of_component[static_cast<std::size_t>(run.component)]);
  }
}

// Without the columns and rows of padding.
std::vector<std::uint16_t> cropped(planes::PixelLabels labels, int width, int height) {
  const auto stride = static_cast<std::ptrdiff_t>(labels.stride);
  const auto begin = labels.values.begin();
  for (std::ptrdiff_t y = 1; y < height && stride != width; ++y) {
    std::copy(begin + y * stride, begin + y * stride + width, begin + y * width);
  }
  labels.values.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return std::move(labels.values);
}

Contour onPlane(std::vector<PixelCorner> corners, const planes::ImagePlane& plane, const Pinhole& camera,
                double max_depth) {
  Contour contour;
  contour.polygon_in_sensor.vertices.reserve(corners.size());
  for (const PixelCorner& corner : corners) {
    const double u = corner.x - 0.5 - camera.cx, v = corner.y - 0.5 - camera.cy;
    // A corner of a pixel that sees a plane edge-on can lie beyond the plane's horizon.
    const double inverse = std::max(plane.at(u, v), 0.5 / max_depth);
    contour.polygon_in_sensor.vertices.emplace_back(u / (camera.fx * inverse), v / (camera.fy * inverse), 1 / inverse);
  }
  contour.corners = std::move(corners);
  return contour;
}

}  // namespace

PlaneSegmenter::PlaneSegmenter(const PlaneOptions& options) : options_(options) {
  if (!(options.min_depth < options.max_depth)) {
    throw base::Error(base::ExitCode::out_of_range,
                      "planes: min_depth_m = " + std::to_string(options.min_depth) + " is not below max_depth_m = " +
                          std::to_string(options.max_depth) + "; make the span from one to the other the sensor's");
  }
}

PlaneSegmentation PlaneSegmenter::segment(const DepthImage& image) const {
  using namespace planes;
  PlaneSegmentation result;
  result.width = image.width();
  result.height = image.height();
  if (result.width == 0 || result.height == 0) return result;

  const DepthNoise noise = options_.noise();
  const Pinhole& camera = image.camera();
  const InverseDepth inverse = invert(image, options_.min_depth, options_.max_depth);
  const CellGrid grid = fitCells(inverse, camera, noise);
  const CellRegions merged = mergeRegions(grid, noise, growRegions(grid, noise));
  const CellRegions regions = dropExplained(inverse, camera, noise, grid, merged);
  PixelLabels labels = labelPixels(inverse, camera, noise, grid, regions);
  const Components components = connectComponents(labels.stride, labels.rows, SameLabel{labels.values.data()});
  auto fitted = fitRegions(inverse, camera, noise, components, labels, regions, options_.min_pixels);
  relabel(components, fitted, labels);
  auto lines = traceOutlines(labels.values, labels.stride, labels.rows, components.runs, options_.min_hole_pixels);
  result.labels = cropped(std::move(labels), result.width, result.height);
  for (TracedLine& line : lines) {
    FittedRegion& region = fitted[line.label - 1U];
    Contour contour = onPlane(std::move(line.corners), region.plane, camera, options_.max_depth);
    if (line.area > 0) {
      region.result.outline = std::move(contour);
    } else {
      region.result.holes.push_back(std::move(contour));
    }
  }
  for (FittedRegion& region : fitted) result.planes.push_back(std::move(region.result));
  return result;
}

}  // namespace omnimapper::perception
