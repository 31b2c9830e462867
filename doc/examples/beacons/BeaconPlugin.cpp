#include "BeaconPlugin.h"

namespace beacons {

namespace map = omnimapper::map;
namespace mapper = omnimapper::mapper;
using mrpt::obs::CObservationBearingRange;

BeaconPlugin::BeaconPlugin(const BeaconOptions& options, const mapper::PluginContext& context)
    : LandmarkPlugin(BeaconIndex(context.section)), options_(options), corrections_(options, context.section) {}

bool BeaconPlugin::wants(const mrpt::obs::CObservation& observation) const {
  return dynamic_cast<const CObservationBearingRange*>(&observation) &&
         (options_.label.empty() || observation.sensorLabel == options_.label);
}

mapper::Batch BeaconPlugin::associate(const map::KeyFrame& frame, const mapper::Observed& observed,
                                      const mapper::View& view) {
  const auto& observation = dynamic_cast<const CObservationBearingRange&>(observed.observation);
  if (observation.sensedData.empty()) return {};
  return BeaconAssociator(options_, known(), corrections_, observation, frame, view).take(measurementsOf(observation));
}

void BeaconPlugin::applied(const mapper::AppliedBatch& ids) {
  corrections_.applied(ids);
  LandmarkPlugin::applied(ids);
}

}  // namespace beacons
