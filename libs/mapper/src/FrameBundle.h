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

/// An observation with what each measurement plugin prepared of it, by the plugins' order; null where that is nothing.
struct Perceived {
  mrpt::obs::CObservation::ConstPtr observation;
  std::vector<std::unique_ptr<const Prepared>> prepared;
};

/// All that the pool made of one observation.
struct PerceivedParts {
  std::vector<Perceived> parts;        ///< the observation itself, then what the extractors made of it, in their order
  std::vector<map::CloudPoint> cloud;  ///< of a depth image, in the base
  ExtractionErrors errors;             ///< of extractors that could not take it
};

/// What the front end hands to the back end: the observations of one stamp that the trigger let through. Without any,
/// the stamp becomes a dependent frame of the key frame before it.
struct FrameBundle {
  base::Stamp stamp;
  bool reference = false;  ///< one observation of that stamp, triggered or not, is of the reference sensor
  std::vector<std::future<PerceivedParts>> observations;  ///< what the workers make of each
};

}  // namespace omnimapper::mapper
