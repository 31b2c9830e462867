#include "PointLandmarksPlugin.h"

#include "PointAssociator.h"
#include "PointMeasurement.h"
#include "PointMerging.h"
#include "PointPayload.h"
#include "RangeBearingFactor.h"

IMPLEMENTS_MRPT_OBJECT(PointLandmarksPluginFactory, omnimapper::mapper::MeasurementPluginFactory, omnimapper::plugins)

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

void PointLandmarksPluginFactory::registerKinds(mapper::Kinds& kinds) const {
  RangeBearingFactor2::addTo(kinds.factors);
  RangeBearingFactor3::addTo(kinds.factors);
  PointPayload::addTo(kinds.payloads);
}

std::unique_ptr<mapper::MeasurementPlugin> PointLandmarksPluginFactory::make(
    const base::ConfigSection& section, const mapper::PluginContext& context) const {
  return std::make_unique<PointLandmarksPlugin>(section.read<PointLandmarksOptions>(mapper::sectionKeysOfEngine()),
                                                context);
}

}  // namespace omnimapper::plugins
