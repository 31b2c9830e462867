#pragma once

#include <omnimapper/base/Progress.h>
#include <omnimapper/check/LogFacts.h>
#include <omnimapper/mapper/SensorPoses.h>
#include <omnimapper/source/ObservationSource.h>

#include <functional>

namespace omnimapper::check {

/// Reads the stream to its end, or until `stop` returns true, and collects statistics on the observations.
/// `sensor_poses`: the sensor poses that the INI sets. Memory grows by some bytes for each observation; only some
/// hundred pairs of scans are kept.
LogFacts gatherFacts(
    source::ObservationSource& log, const mapper::SensorPoses& sensor_poses = {},
    const std::function<bool()>& stop = [] { return false; }, base::Progress* progress = nullptr);

}  // namespace omnimapper::check
