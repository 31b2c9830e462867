#include "SignLandmarksPlugin.h"

#include "NewSigns.h"
#include "SignAssociator.h"
#include "SignBearingFactor.h"
#include "SignClosures.h"
#include "SignEvidence.h"
#include "SignPayload.h"

namespace omnimapper::plugins {

using obs::CObservationDoorSigns;

bool SignLandmarksPlugin::wants(const mrpt::obs::CObservation& observation) const {
  return dynamic_cast<const CObservationDoorSigns*>(&observation) != nullptr &&
         (options_.label.empty() || observation.sensorLabel == options_.label);
}

mapper::Batch SignLandmarksPlugin::associate(const map::KeyFrame& frame, const mapper::Observed& observed,
                                             const mapper::View& view) {
  known().goTo(frame, view, options_.recent_travel);
  return SignAssociator(options_, context_.section, known(), offsets_, session_, frame, view)
      .associate(dynamic_cast<const CObservationDoorSigns&>(observed.observation));
}

void SignLandmarksPlugin::applied(const mapper::AppliedBatch& ids) {
  offsets_.applied(ids);
  LandmarkPlugin::applied(ids);
}

mapper::FollowUp SignLandmarksPlugin::afterCommit(const map::KeyFrame&, const mapper::View& view) {
  if (known().fresh.empty()) return {};
  known().update(view);
  return {proposeSameSigns(known(), options_, context_.section, view), {}};
}

mapper::Batch SignLandmarksPlugin::finish(const mapper::View& view) {
  auto batch = mergeSameSigns(known(), options_, context_.section, view);
  addUnplacedSigns(known(), offsets_, options_, context_.section, view, batch);
  return batch;
}

std::vector<mapper::Evidence> SignLandmarksPlugin::evidence(const mapper::View& view) const {
  return view.map_is_held ? std::vector<mapper::Evidence>()
                          : signEvidence(view, context_.section, options_.recent_travel);
}

void SignLandmarksPlugin::registerKinds(mapper::Kinds& kinds) {
  SignBearingFactor::addTo(kinds.factors);
  PanTiltBearingFactor::addTo(kinds.factors);
  SignRangeFactor::addTo(kinds.factors);
  SignPayload::addTo(kinds.payloads);
}

}  // namespace omnimapper::plugins
