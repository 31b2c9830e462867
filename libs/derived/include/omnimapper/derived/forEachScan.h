#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/map/KeyFrame.h>

#include <memory>

namespace omnimapper::derived {

/// Calls `use(scan)` for each 2D scan of a key frame; `scan` is a shared pointer.
template <class Use>
void forEachScan(const map::KeyFrame& frame, const Use& use) {
  for (const auto& observation : frame.observations) {
    const auto scan = std::dynamic_pointer_cast<const mrpt::obs::CObservation2DRangeScan>(observation);
    if (scan) use(scan);
  }
}

}  // namespace omnimapper::derived
