#include "SignAssociator.h"

#include <omnimapper/plugin/SessionStart.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "NewSigns.h"
#include "SignPayload.h"

namespace omnimapper::plugins {

namespace {

mapper::Decision placementDecision(const std::string& section, const map::KeyFrame& frame, bool is_sure,
                                   std::string reason) {
  mapper::Decision decision(frame, section, mapper::kRelocalization);
  decision.accepted = is_sure;
  decision.reason = std::move(reason);
  return decision;
}

}  // namespace

mapper::Batch SignAssociator::associate(const obs::CObservationDoorSigns& observation) {
  label_ = observation.source_label;
  measurements_ = signMeasurements(observation, measurementOptions());
  if (measurements_.empty()) return {};
  findOffsets();
  if (placeSession(measurements_)) return std::move(batch());
  auto edits = take(measurements_);
  for (const auto id : met()) tracks_.seen(id);
  return edits;
}

SignLandmarksOptions SignAssociator::measurementOptions() const {
  SignLandmarksOptions options = options_;
  if (!view().map_is_held) return options;
  options.pan_sigma = std::hypot(options.pan_sigma, options.pan_tilt_offset_sigma);
  options.tilt_sigma = std::hypot(options.tilt_sigma, options.pan_tilt_offset_sigma);
  return options;
}

void SignAssociator::findOffsets() {
  if (view().map_is_held) return;
  offset_variable_ = offsets_.find(label_, batch());
  if (!offset_variable_) return;
  known_offsets_ = {mapper::PanTiltOffsets::estimate(offset_variable_, view().graph), options_.pan_tilt_offset_sigma};
  if (!areOffsetsInGraph()) return;
  if (const auto covariance = view().jointCovariance({*offset_variable_}))
    known_offsets_.sigma = std::sqrt(covariance->diagonal().maxCoeff());
}

bool SignAssociator::areOffsetsInGraph() const {
  return !offset_variable_ || !mapper::Batch::isProvisional(*offset_variable_);
}

bool SignAssociator::placeSession(const std::vector<SignMeasurement>& measurements) {
  if (!mapper::whyFixed({frame().id, {}}, view().graph, view().map).empty()) {
    session_ = SessionBySigns();  // a factor ties it to the map; if that is taken back, the search starts anew
    return false;
  }
  const auto placement = session_.take(measurements, frame(), tracks_, view(), known_offsets_, options_.recent_travel);
  if (!placement) return false;
  batch().placeSession(placement->place);
  batch().log(placementDecision(section(), frame(), placement->is_sure, placement->reason));
  return placement->is_sure;
}

void SignAssociator::describe(const SignMeasurement& /*measurement*/, mapper::Decision& decision) const {
  decision.kind = "sign measurement";
}

std::vector<base::LandmarkId> SignAssociator::candidates(const SignMeasurement& measurement) {
  std::vector<base::LandmarkId> alike;
  if (!areOffsetsInGraph()) return alike;
  // A measurement of a number alone is not associated with a sign of which only words are known, however near: that
  // sign may be a poster beside the number.
  for (const auto& [id, known] : tracks_.all()) {
    if (mayBeAssociated(known) && agreementOf(measurement.text, signOf(view(), id).text()) >= Agreement::partly)
      alike.push_back(id);
  }
  return alike;
}

bool SignAssociator::mayBeAssociated(const KnownSign& known) const {
  const bool is_own = known.id.session == frame().id.session;
  if (session_.isPlaced()) return !is_own;
  if (view().map_is_held) return !session_.isLost();
  return (is_own || !session_.isLost()) && tracks_.isRecent(known, options_.recent_travel);
}

graph::FactorRecord SignAssociator::record(const SignMeasurement& measurement, base::VariableId sign) const {
  return measurement.directionRecord(frame().pose, sign, offset_variable_, options_);
}

std::shared_ptr<const map::LandmarkPayload> SignAssociator::learned(const SignMeasurement& measurement,
                                                                    const landmarks::LandmarkIds& known) {
  if (auto range = measurement.rangeRecord(frame().pose, known.variable))
    batch().addFactor(ofLandmark(std::move(*range), known.landmark, section()));
  auto payload = payloadOf<SignPayload>(known.landmark).with(measurement.text, label_);
  if (payload->isBetter(measurement.area_px) && !view().map_is_held) payload->best_look = measurement.look(frame().id);
  return payload;
}

void SignAssociator::addNew(const SignMeasurement& measurement, mapper::Decision decision) {
  constexpr std::size_t kMinViews = 3;  // with two directions, nothing would show that one of them is wrong
  if (isOneOfSeveral(measurement)) {
    decision.reason = "another sign in the image has the same text";
    return batch().log(std::move(decision));
  }
  const auto& views = tracks_.waitingWith(
      {frame().id, frame().stamp, frame().pose, label_, measurement, tracks_.travelled()}, options_.recent_travel);
  const auto place = triangulate(views, view().graph, known_offsets_, options_.max_sigma, kMinViews);
  decision.numbers.emplace_back("directions", static_cast<double>(views.size()));
  if (!place) {
    decision.reason = "waits for a direction that determines its position";
    return batch().log(std::move(decision));
  }
  decision.accepted = true;
  decision.reason = "new";
  batch().log(std::move(decision));
  addSign(views, *place, offsets_, options_, section(), batch());
  tracks_.forget(place->views);
}

bool SignAssociator::isOneOfSeveral(const SignMeasurement& measurement) const {
  return std::any_of(measurements_.begin(), measurements_.end(), [&](const SignMeasurement& other) {
    return &other != &measurement && agreementOf(other.text, measurement.text) == Agreement::agrees;
  });
}

}  // namespace omnimapper::plugins
