#include "Description.h"

#include <algorithm>

#include "Outlines.h"
#include "RegionFit.h"

namespace omnimapper::perception::planes {

namespace {

// Replaces the labels of cell regions by those of the fitted planes, or by 0 where no plane was fitted.
void relabel(const Components& components, const std::vector<FittedRegion>& fitted, PixelLabels& labels) {
  std::vector<std::uint16_t> of_component(components.pixels.size(), 0);
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    of_component[static_cast<std::size_t>(fitted[i].component)] = static_cast<std::uint16_t>(i + 1);
  }
  for (const PixelRun& run : components.runs) {
    const auto row = labels.values.begin() + static_cast<std::ptrdiff_t>(run.row) * labels.stride;
    std::fill(row + run.begin, row + run.end, of_component[static_cast<std::size_t>(run.component)]);
  }
}

// Removes the columns and rows of padding.
std::vector<std::uint16_t> cropped(PixelLabels labels, int width, int height) {
  const auto stride = static_cast<std::ptrdiff_t>(labels.stride);
  const auto begin = labels.values.begin();
  for (std::ptrdiff_t y = 1; y < height && stride != width; ++y) {
    std::copy(begin + y * stride, begin + y * stride + width, begin + y * width);
  }
  labels.values.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return std::move(labels.values);
}

Contour onPlane(std::vector<PixelCorner> corners, const ImagePlane& plane, const camera::Pinhole& camera,
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

void clearOthers(const Components& components, PixelLabels& labels) {
  auto done = labels.values.begin();
  for (const PixelRun& run : components.runs) {
    const auto row = labels.values.begin() + static_cast<std::ptrdiff_t>(run.row) * labels.stride;
    std::fill(done, row + run.begin, std::uint16_t(0));
    done = row + run.end;
  }
  std::fill(done, labels.values.end(), std::uint16_t(0));
}

PlaneSegmentation describe(const InverseDepth& inverse, const camera::Pinhole& camera, const camera::DepthNoise& noise,
                           const CellRegions& regions, PixelLabels labels, const Components& components,
                           const DescriptionLimits& limits) {
  PlaneSegmentation result;
  result.width = inverse.width;
  result.height = inverse.height;
  auto fitted = fitRegions(inverse, camera, noise, components, labels, regions, limits.min_pixels);
  relabel(components, fitted, labels);
  auto lines = traceOutlines(labels.values, labels.stride, labels.rows, components.runs, limits.min_hole_pixels);
  result.labels = cropped(std::move(labels), result.width, result.height);
  for (TracedLine& line : lines) {
    FittedRegion& region = fitted[line.label - 1U];
    Contour contour = onPlane(std::move(line.corners), region.plane, camera, limits.max_depth);
    if (line.area > 0) {
      region.result.outline = std::move(contour);
    } else {
      region.result.holes.push_back(std::move(contour));
    }
  }
  for (FittedRegion& region : fitted) result.planes.push_back(std::move(region.result));
  return result;
}

}  // namespace omnimapper::perception::planes
