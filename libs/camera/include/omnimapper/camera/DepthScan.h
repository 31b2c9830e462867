#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>

namespace omnimapper::camera {

/// The scan of a range camera with a depth image; null for any other observation.
inline const mrpt::obs::CObservation3DRangeScan* depthScanOf(const mrpt::obs::CObservation& raw) {
  const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&raw);
  return scan != nullptr && scan->hasRangeImage ? scan : nullptr;
}

}  // namespace omnimapper::camera
