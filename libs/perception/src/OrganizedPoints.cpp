#include <omnimapper/perception/OrganizedPoints.h>

#include "planes/InverseDepth.h"
#include "planes/Lanes.h"

namespace omnimapper::perception {

namespace {

using planes::kLanes;
using planes::LaneMask;
using planes::Lanes;

// A row of pixels, padded to whole cells. Its rays have x = `across`, y = `down` and z = 1.
struct RowTask {
  const float *inverse_depth, *across;
  float down;
  int stride;
};

OMNIMAPPER_KERNEL_BODY void projectRowBody(const RowTask& row, float* x, float* y, float* z) {
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  for (int u = 0; u < row.stride; u += kLanes) {
    Lanes inverse, across;
    planes::load(inverse, row.inverse_depth + u);
    planes::load(across, row.across + u);
    const LaneMask measured = inverse > 0.F;
    const Lanes depth = measured ? 1.F / (measured ? inverse : Lanes{} + 1.F) : Lanes{} + kNothing;
    planes::store(depth * across, x + u);
    planes::store(depth * row.down, y + u);
    planes::store(depth, z + u);
  }
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 void projectRowAvx2(const RowTask& row, float* x, float* y, float* z) {
  projectRowBody(row, x, y, z);
}
#endif

void projectRow(const RowTask& row, float* x, float* y, float* z) {
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (planes::hasAvx2()) return projectRowAvx2(row, x, y, z);
#endif
  projectRowBody(row, x, y, z);
}

}  // namespace

OrganizedPoints backProject(const camera::DepthImage& image, double min_depth, double max_depth) {
  const planes::InverseDepth inverse = planes::invert(image, min_depth, max_depth);
  const camera::Pinhole& camera = image.camera();
  OrganizedPoints points;
  points.width = image.width();
  points.height = image.height();
  const auto stride = static_cast<std::size_t>(inverse.stride);
  std::vector<float> across(stride), x(stride), y(stride), z(stride);
  for (std::size_t u = 0; u < stride; ++u) {
    across[u] = static_cast<float>((static_cast<double>(u) - camera.cx) / camera.fx);
  }
  const auto pixels = static_cast<std::size_t>(points.width) * static_cast<std::size_t>(points.height);
  for (auto* all : {&points.x, &points.y, &points.z}) all->reserve(pixels);
  for (int v = 0; v < points.height; ++v) {
    const auto down = static_cast<float>((static_cast<double>(v) - camera.cy) / camera.fy);
    projectRow({inverse.at(0, v), across.data(), down, inverse.stride}, x.data(), y.data(), z.data());
    points.x.insert(points.x.end(), x.begin(), x.begin() + points.width);
    points.y.insert(points.y.end(), y.begin(), y.begin() + points.width);
    points.z.insert(points.z.end(), z.begin(), z.begin() + points.width);
  }
  return points;
}

}  // namespace omnimapper::perception
