#pragma once

#include <omnimapper/perception/PlaneExtractor.h>
#include <omnimapper/perception/PlaneRegion.h>

namespace omnimapper::perception::planes {

/// On a blackboard: the planes that an extractor has found in a depth image, and has made an observation of.
struct FoundPlanes {
  PlaneSettings settings;
  PlaneSegmentation planes;
};

}  // namespace omnimapper::perception::planes
