#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "RgbdFrames.h"

namespace omnimapper::bench {

/// Somebody's way to edges.
struct EdgePeer {
  std::string name;
  /// Hands over a frame; not timed.
  std::function<void(const RgbdFrame&)> take;
  /// For each pixel the bits of perception::EdgeKind; timed.
  std::function<std::vector<std::uint8_t>()> run;
};

/// None where bench-edges was built without it: occluding, occluded and boundary; high curvature with normals; RGB; and
/// all at once.
std::vector<EdgePeer> pclEdges();
/// All five kinds with normals, by the smallest jump that counts; none as above.
std::vector<EdgePeer> pclEdgesOfAllKinds();

}  // namespace omnimapper::bench
