#include <omnimapper/base/Error.h>
#include <omnimapper/perception/EdgeImage.h>

#include <algorithm>
#include <string>

namespace omnimapper::perception {

const char* nameOf(EdgeKind kind) {
  switch (kind) {
    case kBoundary:
      return "boundary";
    case kOccluding:
      return "occluding";
    case kOccluded:
      return "occluded";
    case kHighCurvature:
      return "high_curvature";
    case kRgb:
      return "rgb";
  }
  return "";
}

std::vector<Eigen::Vector3f> edgePoints(const EdgeImage& edges, const camera::DepthImage& image, unsigned kinds) {
  if (image.width() != edges.width || image.height() != edges.height) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "edges of " + std::to_string(edges.width) + " x " + std::to_string(edges.height) +
                          " pixels, but a depth image of " + std::to_string(image.width()) + " x " +
                          std::to_string(image.height()));
  }
  const camera::Pinhole& camera = image.camera();
  std::vector<Eigen::Vector3f> points;
  points.reserve(static_cast<std::size_t>(std::count_if(edges.labels.begin(), edges.labels.end(),
                                                        [&](std::uint8_t label) { return (label & kinds) != 0; })));
  std::size_t i = 0;
  for (int y = 0; y < edges.height; ++y) {
    const auto down = static_cast<float>((y - camera.cy) / camera.fy);
    for (int x = 0; x < edges.width; ++x, ++i) {
      if ((edges.labels[i] & kinds) == 0) continue;
      const auto z =
          image.units() != nullptr ? static_cast<float>(image.units()[i] * image.metresPerUnit()) : image.metres()[i];
      points.emplace_back(z * static_cast<float>((x - camera.cx) / camera.fx), z * down, z);
    }
  }
  return points;
}

}  // namespace omnimapper::perception
