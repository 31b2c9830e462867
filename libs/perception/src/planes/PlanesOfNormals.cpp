#include <omnimapper/perception/GrowLabels.h>
#include <omnimapper/perception/Normals.h>
#include <omnimapper/perception/SmoothComparator.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../DepthSensor.h"
#include "LabelledPlanes.h"

namespace omnimapper::perception::planes {

namespace {

// Largest residual of a pixel that a plane grows over, and RMS residual of a flat component, in standard deviations.
constexpr double kSigmas = 3, kFlatSigmas = 1.5;
constexpr int kRadius = 7;                  // [px] of the windows in which normals are fitted
constexpr float kMinCosine = 0.9962F;       // of the largest angle between neighbours' normals, 5 deg
constexpr std::size_t kMostPlanes = 65535;  // labels have 16 bits

std::vector<PlaneMoments> momentsOf(const Components& components, const InverseDepth& inverse,
                                    const camera::Pinhole& camera) {
  std::vector<PlaneMoments> moments(components.pixels.size());
  for (const PixelRun& run : components.runs) {
    PlaneMoments& m = moments[static_cast<std::size_t>(run.component)];
    const double v = run.row - camera.cy;
    for (int x = run.begin; x < run.end; ++x) {
      const double u = x - camera.cx, q = static_cast<double>(*inverse.at(x, run.row));
      m += {1, u, v, u * u, u * v, v * v, q, u * q, v * q, q * q};
    }
  }
  return moments;
}

/// Comparator for growLabels(): whether a pixel lies on the plane of its neighbour (thesis 3.4.4).
struct RefinementComparator {
  const InverseDepth& inverse;
  const camera::Pinhole& camera;
  const std::vector<CellRegions::Region>& regions;
  const std::vector<std::int32_t>& labels;
  double tolerance;  // [1/m]

  double inverseDepth(int pixel) const {
    return static_cast<double>(*inverse.at(pixel % inverse.width, pixel / inverse.width));
  }
  bool valid(int pixel) const { return inverseDepth(pixel) > 0; }
  bool similar(int of_plane, int pixel) const {
    const int label = labels[static_cast<std::size_t>(of_plane)];
    const ImagePlane& plane = regions[static_cast<std::size_t>(label - 1)].plane;
    const double u = pixel % inverse.width - camera.cx, v = pixel / inverse.width - camera.cy;
    return std::abs(inverseDepth(pixel) - plane.at(u, v)) <= tolerance;
  }
};

PixelLabels padded(const std::vector<std::int32_t>& labels, const InverseDepth& inverse) {
  PixelLabels result;
  result.stride = inverse.stride;
  result.rows = inverse.rows;
  result.values.resize(static_cast<std::size_t>(inverse.stride) * static_cast<std::size_t>(inverse.rows), 0);
  for (std::ptrdiff_t y = 0; y < inverse.height; ++y) {
    const auto from = labels.begin() + y * inverse.width;
    std::transform(from, from + inverse.width, result.values.begin() + y * inverse.stride,
                   [](std::int32_t label) { return static_cast<std::uint16_t>(label); });
  }
  return result;
}

}  // namespace

LabelledPlanes planesOfNormals(const camera::DepthImage& image, const InverseDepth& inverse,
                               const PlaneOptions& options) {
  const OrganizedPoints points = backProject(image, options.min_depth, options.max_depth);
  const NormalImage normals = NormalEstimator(normalsBy(options, kRadius)).estimate(image);
  const double variance = options.noise().pixelVariance() + options.distortion_at_1m * options.distortion_at_1m;
  const SmoothComparator comparator{points, normals, kMinCosine, static_cast<float>(kSigmas * std::sqrt(variance))};
  const Components components = connectComponents(image.width(), image.height(), comparator);

  LabelledPlanes planes;
  std::vector<std::int32_t> number(components.pixels.size(), 0);
  const auto moments = momentsOf(components, inverse, image.camera());
  for (std::size_t i = 0; i < moments.size() && planes.regions.regions.size() < kMostPlanes; ++i) {
    if (components.pixels[i] < options.min_pixels) continue;
    const ImagePlaneFit fit = moments[i].fit();
    if (fit.squares > kFlatSigmas * kFlatSigmas * variance * moments[i].n) continue;
    planes.regions.regions.push_back({moments[i], fit.plane});
    number[i] = static_cast<std::int32_t>(planes.regions.regions.size());
  }
  auto labels = components.labels();
  for (std::int32_t& label : labels) label = label > 0 ? number[static_cast<std::size_t>(label - 1)] : 0;
  growLabels(
      image.width(), image.height(),
      RefinementComparator{inverse, image.camera(), planes.regions.regions, labels, kSigmas * std::sqrt(variance)},
      std::numeric_limits<int>::max(), labels);
  planes.labels = padded(labels, inverse);
  return planes;
}

}  // namespace omnimapper::perception::planes
