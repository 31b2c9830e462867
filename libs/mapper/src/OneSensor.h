#pragma once

#include <mrpt/obs/CObservation.h>

namespace omnimapper::mapper {

/// Whether two observations with the same stamp are of the same sensor: their labels and classes are equal.
inline bool isOfOneSensor(const mrpt::obs::CObservation& a, const mrpt::obs::CObservation& b) {
  return a.sensorLabel == b.sensorLabel && a.GetRuntimeClass() == b.GetRuntimeClass();
}

}  // namespace omnimapper::mapper
