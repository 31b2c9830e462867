#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "RgbdFrames.h"

namespace omnimapper::bench {

/// A method that finds edges.
struct EdgePeer {
  std::string name;
  /// Receives a frame. Not timed.
  std::function<void(const RgbdFrame&)> take;
  /// For each pixel the bits of perception::EdgeKind. Timed.
  std::function<std::vector<std::uint8_t>()> run;
};

/// PCL's methods: occluding, occluded and boundary edges; high curvature with normals; RGB; and all at once. Empty if
/// bench-edges was built without PCL.
std::vector<EdgePeer> pclEdges();
/// PCL's method for all five kinds with normals, with two depth thresholds. Empty if bench-edges was built without PCL.
std::vector<EdgePeer> pclEdgesOfAllKinds();

}  // namespace omnimapper::bench
