#include <omnimapper/perception/OrganisedPoints.h>

#include "planes/InverseDepth.h"

namespace omnimapper::perception {

OrganisedPoints backProject(const DepthImage& image, double min_depth, double max_depth) {
  const planes::InverseDepth inverse = planes::invert(image, min_depth, max_depth);
  const Pinhole& camera = image.camera();
  const auto width = static_cast<std::size_t>(image.width()), height = static_cast<std::size_t>(image.height());
  OrganisedPoints points;
  points.width = image.width();
  points.height = image.height();
  points.x.resize(width * height);
  points.y.resize(width * height);
  points.z.resize(width * height);
  std::vector<float> across(width);
  for (std::size_t u = 0; u < width; ++u) {
    across[u] = static_cast<float>((static_cast<double>(u) - camera.cx) / camera.fx);
  }
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t v = 0, first = 0; v < height; ++v, first += width) {
    const float* from = inverse.at(0, static_cast<int>(v));
    const auto down = static_cast<float>((static_cast<double>(v) - camera.cy) / camera.fy);
    for (std::size_t u = 0; u < width; ++u) {
      const float z = from[u] > 0 ? 1.F / from[u] : kNothing;
      points.x[first + u] = z * across[u];
      points.y[first + u] = z * down;
      points.z[first + u] = z;
    }
  }
  return points;
}

}  // namespace omnimapper::perception
