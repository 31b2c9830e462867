#include "PointLandmarksPlugin.h"

#include "PointAssociator.h"
#include "PointMeasurement.h"
#include "PointMerging.h"
#include "PointPayload.h"
#include "RangeBearingFactor.h"

namespace omnimapper::plugins {

using mrpt::obs::CObservationBearingRange;

bool PointLandmarksPlugin::wants(const mrpt::obs::CObservation& observation) const {
  return dynamic_cast<const CObservationBearingRange*>(&observation) &&
         (options_.label.empty() || observation.sensorLabel == options_.label);
}

mapper::Batch PointLandmarksPlugin::associate(const map::KeyFrame& frame, const mapper::Observed& observed,
                                              const mapper::View& view) {
  const auto& observation = dynamic_cast<const CObservationBearingRange&>(observed.observation);
  return PointAssociator(options_, context_, known(), frame, view, observation.sensorLabel)
      .take(pointMeasurements(observation, context_.motion, options_));
}

mapper::Batch PointLandmarksPlugin::merge(const mapper::View& view) {
  return mergeAlike(known(), options_, context_.section, view);
}

void PointLandmarksPlugin::registerKinds(mapper::Kinds& kinds) {
  RangeBearingFactor2::addTo(kinds.factors);
  RangeBearingFactor3::addTo(kinds.factors);
  PointPayload::addTo(kinds.payloads);
}

}  // namespace omnimapper::plugins
