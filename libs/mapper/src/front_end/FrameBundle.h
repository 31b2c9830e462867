#pragma once

#include <omnimapper/base/Stamp.h>

#include <future>
#include <vector>

#include "front_end/Perception.h"

namespace omnimapper::mapper {

/// The observations of one stamp that the trigger let through. Without any, the stamp becomes a dependent frame of the
/// key frame before it.
struct FrameBundle {
  base::Stamp stamp;
  bool reference = false;  ///< one observation of that stamp, triggered or not, is of the reference sensor
  std::vector<std::future<PerceivedParts>> observations;  ///< what the workers make of each
};

}  // namespace omnimapper::mapper
