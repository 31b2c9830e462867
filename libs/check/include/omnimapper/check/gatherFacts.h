#pragma once

#include <omnimapper/base/Progress.h>
#include <omnimapper/check/LogFacts.h>
#include <omnimapper/mapper/SensorPoses.h>
#include <omnimapper/source/ObservationSource.h>

#include <functional>

namespace omnimapper::check {

/// Reads the stream to its end, or until `stop`, and tells what it holds. `sensor_poses` are those the INI tells.
/// Memory grows with the number of observations by some bytes each; scans are kept of some hundred pairs only.
LogFacts gatherFacts(
    source::ObservationSource& log, const mapper::SensorPoses& sensor_poses = {},
    const std::function<bool()>& stop = [] { return false; }, base::Progress* progress = nullptr);

}  // namespace omnimapper::check
