#pragma once

#include <omnimapper/camera/DepthImage.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace omnimapper::perception {

/// Kinds of edges (thesis 3.1), as bits of a pixel's label: a pixel may be on edges of several kinds.
enum EdgeKind : std::uint8_t {
  kBoundary = 1,       ///< beside missing data: a hole wider than max_hole, or one that reaches the image's border
  kOccluding = 2,      ///< on the near side of a depth discontinuity
  kOccluded = 4,       ///< on the far side of a depth discontinuity
  kHighCurvature = 8,  ///< the surface turns, without a depth discontinuity
  kRgb = 16,           ///< the colour changes
};

constexpr std::array<EdgeKind, 5> kEdgeKinds{kBoundary, kOccluding, kOccluded, kHighCurvature, kRgb};

/// "boundary", "occluding", "occluded", "high_curvature", "rgb".
const char* nameOf(EdgeKind kind);

/// For each pixel of a depth image, row by row, the kinds of edges that it is on.
struct EdgeImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> labels;
};

/// The points [m] of all pixels with one of `kinds`, row by row, in the camera's optical frame: x right, y down, z
/// forward. Every pixel on an edge has a depth. Throws Error(unreadable_input) if `image` does not have the size of
/// `edges`.
std::vector<Eigen::Vector3f> edgePoints(const EdgeImage& edges, const camera::DepthImage& image, unsigned kinds);

}  // namespace omnimapper::perception
