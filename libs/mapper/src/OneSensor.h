#pragma once

#include <mrpt/obs/CObservation.h>

namespace omnimapper::mapper {

/// Whether two observations of one moment tell the same thing: label and class are the same.
inline bool isOfOneSensor(const mrpt::obs::CObservation& a, const mrpt::obs::CObservation& b) {
  return a.sensorLabel == b.sensorLabel && a.GetRuntimeClass() == b.GetRuntimeClass();
}

}  // namespace omnimapper::mapper
