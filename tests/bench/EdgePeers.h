#pragma once

#include <omnimapper/perception/DepthImage.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace omnimapper::bench {

/// A 16-bit depth image and the picture of the same view, three bytes a pixel: red, green, blue.
struct EdgeFrame {
  int width = 0, height = 0;
  double metres_per_unit = 1;
  perception::Pinhole camera;
  std::vector<std::uint16_t> units;
  std::vector<std::uint8_t> rgb;
};

/// Somebody's way to edges.
struct EdgePeer {
  std::string name;
  /// Hands over a frame; not timed.
  std::function<void(const EdgeFrame&)> take;
  /// For each pixel the bits of perception::EdgeKind; timed.
  std::function<std::vector<std::uint8_t>()> run;
};

/// None where bench-edges was built without it: occluding, occluded and boundary; high curvature with normals; RGB; and
/// all at once.
std::vector<EdgePeer> pclEdges();

}  // namespace omnimapper::bench
