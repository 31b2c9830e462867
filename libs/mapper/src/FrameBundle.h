#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/map/CloudPoint.h>
#include <omnimapper/plugin/MeasurementPlugin.h>

#include <future>
#include <memory>
#include <vector>

#include "ExtractionErrors.h"

namespace omnimapper::mapper {

/// An observation and the result of prepare() of each measurement plugin, in the order of the plugins; null where a
/// plugin does not want the observation.
struct Perceived {
  mrpt::obs::CObservation::ConstPtr observation;
  std::vector<std::unique_ptr<const Prepared>> prepared;
};

/// The results of perception for one observation.
struct PerceivedParts {
  std::vector<Perceived> parts;  ///< the observation itself, then those that the extractors derived, in their order
  std::vector<map::CloudPoint> cloud;  ///< points of a depth image in the base frame
  ExtractionErrors errors;             ///< errors of extractors that could not process it
};

/// An observation that a plugin returned to the engine, or one of a sensor.
struct Arrival {
  mrpt::obs::CObservation::Ptr observation;
  int generation = 0;  ///< 0: of a sensor; n + 1: a watcher's answer to one of generation n
};

/// Passed from the front end to the back end: the observations of one stamp that triggered a key frame. If there are
/// none and `reference` is set, the stamp becomes a dependent frame of the key frame before it.
struct FrameBundle {
  base::Stamp stamp;
  bool reference = false;  ///< an observation of that stamp, triggered or not, is of the reference sensor
  std::vector<std::future<PerceivedParts>> observations;  ///< results of perception, one for each observation
  std::vector<Arrival> watched;                           ///< what watchers see, in the order of arrival

  /// Whether nothing of it waits for perception or becomes part of the trajectory.
  bool isOnlyWatched() const { return observations.empty() && !reference; }
};

}  // namespace omnimapper::mapper
