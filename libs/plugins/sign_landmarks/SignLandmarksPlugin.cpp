#include "SignLandmarksPlugin.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/landmarks/InterSessionHypothesis.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <cmath>
#include <optional>
#include <utility>

#include "NewSigns.h"
#include "SessionBySigns.h"
#include "SignBearingFactor.h"
#include "SignClosures.h"
#include "SignEvidence.h"
#include "SignMeasurement.h"
#include "SignPayload.h"
#include "SignTracks.h"
#include "Triangulation.h"

IMPLEMENTS_MRPT_OBJECT(SignLandmarksPluginFactory, omnimapper::mapper::MeasurementPluginFactory, omnimapper::plugins)

namespace omnimapper::plugins {

using obs::CObservationDoorSigns;

const base::OptionTable<SignLandmarksOptions>& SignLandmarksOptions::table() {
  using Options = SignLandmarksOptions;
  using base::Range;
  static const auto table = [] {
    auto own =
        base::OptionTable<Options>()
            .text("label", &Options::label,
                  "Sensor label of the sign observations, such as \"camera.signs\"; empty for those of every camera.")
            .number("min_confidence", &Options::min_confidence, {0, 1},
                    "Lines of text with a lower confidence than this are not used.")
            .number("pixel_sigma_deg", &Options::pixel_sigma, Range{0.001, 45},
                    "Standard deviation of the direction to the middle of a sign in the image, apart from the errors "
                    "of the camera's pan and tilt angles.")
            .number("pan_sigma_deg", &Options::pan_sigma, Range{0, 45},
                    "Standard deviation of the error of the pan angle that a camera reports. The error differs from "
                    "image to image.")
            .number("tilt_sigma_deg", &Options::tilt_sigma, Range{0, 45},
                    "Standard deviation of the error of the tilt angle that a camera reports. The error differs from "
                    "image to image.")
            .number("pan_tilt_offset_sigma_deg", &Options::pan_tilt_offset_sigma, Range{0, 45},
                    "Standard deviation of the constant offsets of the camera's pan and tilt angles, which are "
                    "estimated; 0 assumes that there are no offsets.")
            .number("max_sigma_m", &Options::max_sigma, Range{0.001, 100},
                    "A new sign is added to the map once the standard deviation of its position is at most this. Until "
                    "then only the directions to the sign are kept.")
            .number("recent_m", &Options::recent_travel, Range::positive(),
                    "If the robot has travelled farther than this since it last measured a sign, new measurements of "
                    "the sign make a second landmark, and a hypothesis that both are one sign. If the hypothesis is "
                    "accepted, it closes a loop.")
            .number("same_sigma_m", &Options::same_sigma, Range{0.001, 10},
                    "Standard deviation of the difference between the positions of one sign as measured on two visits.")
            .number("loss_scale", &Options::loss_scale, Range{0.1, 100},
                    "Number of standard deviations beyond which a measurement that disagrees loses influence (scale of "
                    "the Cauchy loss).");
    return declareIn(own);
  }();
  return table;
}

namespace {

mapper::Decision placementDecision(const std::string& section, const map::KeyFrame& frame, bool is_sure,
                                   std::string reason) {
  mapper::Decision decision;
  decision.stamp = frame.stamp;
  decision.plugin = section;
  decision.kind = mapper::kRelocalization;
  decision.from = frame.id;
  decision.accepted = is_sure;
  decision.reason = std::move(reason);
  return decision;
}

}  // namespace

// Associates the signs of one observation and makes the edits of graph and map.
class SignLandmarksPlugin::Work {
 public:
  Work(const SignLandmarksOptions& options, const mapper::PluginContext& context, SignTracks& tracks,
       mapper::PanTiltOffsets& offsets, SessionBySigns& session, const map::KeyFrame& frame, const mapper::View& view)
      : options_(options),
        context_(context),
        tracks_(tracks),
        offsets_(offsets),
        session_(session),
        frame_(frame),
        view_(view) {}

  mapper::Batch take(const CObservationDoorSigns& observation) {
    label_ = observation.source_label;
    const auto measurements = signMeasurements(observation, optionsHere());
    if (measurements.empty()) return {};
    findOffsets();
    if (placeSession(measurements)) return std::move(batch_);
    std::vector<mapper::Pairing> pairings;
    for (std::size_t i = 0; i < measurements.size() && areOffsetsInGraph(); ++i) {
      for (const auto& [id, known] : tracks_.known()) {
        if (!mayBeAssociated(id, known)) continue;
        // A measurement of a number alone is not associated with a sign of which only words are known, however near:
        // that sign may be a poster beside the number.
        if (agreementOf(measurements[i].text, signOf(view_, id).text()) < Agreement::partly) continue;
        pairings.push_back({i, id, record(measurements[i], known.variable, id)});
      }
    }
    const auto found = mapper::associate(measurements.size(), pairings, view_, options_, mapper::Repeats::no);
    for (std::size_t i = 0; i < measurements.size(); ++i) {
      const auto& match = found.matches[i];
      mapper::Decision decision = decisionOf();
      found.describe(i, decision);
      if (match.kind == mapper::Match::Kind::matched) {
        addToKnown(measurements[i], pairings[*match.pairing], std::move(decision));
      } else if (isOneOfSeveral(measurements, i)) {
        decision.reason = "another sign in the image has the same text";
        batch_.log(std::move(decision));
      } else if (match.kind == mapper::Match::Kind::unknown && !view_.map_is_held) {
        wait(measurements[i], std::move(decision));
      } else {
        batch_.log(std::move(decision));
      }
    }
    return std::move(batch_);
  }

 private:
  // If the map is held, the offsets of the camera are not estimated, and their uncertainty counts as noise.
  SignLandmarksOptions optionsHere() const {
    SignLandmarksOptions options = options_;
    if (!view_.map_is_held) return options;
    options.pan_sigma = std::hypot(options.pan_sigma, options.pan_tilt_offset_sigma);
    options.tilt_sigma = std::hypot(options.tilt_sigma, options.pan_tilt_offset_sigma);
    return options;
  }

  void findOffsets() {
    if (view_.map_is_held) return;
    offset_variable_ = offsets_.find(label_, batch_);
    if (!offset_variable_) return;
    known_offsets_ = {mapper::PanTiltOffsets::estimate(offset_variable_, view_.graph), options_.pan_tilt_offset_sigma};
    if (!areOffsetsInGraph()) return;
    if (const auto covariance = view_.jointCovariance({*offset_variable_}))
      known_offsets_.sigma = std::sqrt(covariance->diagonal().maxCoeff());
  }

  // A session that signs have placed is matched with the signs of the map only, until a factor ties it to the map; a
  // lost session is matched with its own signs only.
  bool mayBeAssociated(base::LandmarkId id, const SignTracks::Known& known) const {
    const bool is_own = id.session == frame_.id.session;
    if (session_.isPlaced()) return !is_own;
    if (view_.map_is_held) return !session_.isLost();
    return (is_own || !session_.isLost()) && tracks_.isRecent(known, options_.recent_travel);
  }

  // Returns whether the session was placed reliably. Its signs are then associated from the next key frame on, from the
  // new place.
  bool placeSession(const std::vector<SignMeasurement>& measurements) {
    if (!mapper::whyFixed({frame_.id, {}}, view_.graph, view_.map).empty()) {
      session_ = SessionBySigns();  // a factor ties it to the map; if that is taken back, the search starts anew
      return false;
    }
    const auto placement = session_.take(measurements, frame_, tracks_, view_, known_offsets_, options_.recent_travel);
    if (!placement) return false;
    batch_.placeSession(placement->place);
    batch_.log(placementDecision(context_.section, frame_, placement->is_sure, placement->reason));
    return placement->is_sure;
  }

  bool areOffsetsInGraph() const { return !offset_variable_ || !mapper::Batch::isProvisional(*offset_variable_); }

  graph::FactorRecord record(const SignMeasurement& measurement, base::VariableId point,
                             base::LandmarkId landmark) const {
    return ofLandmark(measurement.directionRecord(frame_.pose, point, offset_variable_, options_), landmark,
                      context_.section);
  }

  mapper::Decision decisionOf() const {
    mapper::Decision decision;
    decision.stamp = frame_.stamp;
    decision.plugin = context_.section;
    decision.kind = "sign measurement";
    decision.from = frame_.id;
    return decision;
  }

  static bool isOneOfSeveral(const std::vector<SignMeasurement>& measurements, std::size_t which) {
    for (std::size_t i = 0; i < measurements.size(); ++i)
      if (i != which && agreementOf(measurements[i].text, measurements[which].text) == Agreement::agrees) return true;
    return false;
  }

  void addToKnown(const SignMeasurement& measurement, const mapper::Pairing& pairing, mapper::Decision decision) {
    tracks_.seen(pairing.landmark);
    if (landmarks::addInterSessionHypothesis(view_, frame_.id, pairing, decision, batch_)) return;
    batch_.log(std::move(decision));
    batch_.addFactor(pairing.record);
    if (auto range = measurement.rangeRecord(frame_.pose, pairing.record.variables[1]))
      batch_.addFactor(ofLandmark(std::move(*range), pairing.landmark, context_.section));
    auto payload = signOf(view_, pairing.landmark).with(measurement.text, label_);
    if (payload->isBetter(measurement.area_px) && !view_.map_is_held) payload->best_look = measurement.look(frame_.id);
    batch_.addEvidence(pairing.landmark, std::move(payload));
  }

  // A sign that is not in the map: it is added once enough directions meet.
  void wait(const SignMeasurement& measurement, mapper::Decision decision) {
    constexpr std::size_t kMinViews = 3;  // with two directions, nothing would show that one of them is wrong
    const auto& views = tracks_.waitingWith(
        {frame_.id, frame_.stamp, frame_.pose, label_, measurement, tracks_.travelled()}, options_.recent_travel);
    const auto place = triangulate(views, view_.graph, known_offsets_, options_.max_sigma, kMinViews);
    decision.numbers.emplace_back("directions", static_cast<double>(views.size()));
    if (!place) {
      decision.reason = "waits for a direction that determines its position";
      return batch_.log(std::move(decision));
    }
    decision.accepted = true;
    decision.reason = "new";
    batch_.log(std::move(decision));
    addSign(views, *place, offsets_, options_, context_.section, batch_);
    tracks_.forget(place->views);
  }

  const SignLandmarksOptions& options_;
  const mapper::PluginContext& context_;
  SignTracks& tracks_;
  mapper::PanTiltOffsets& offsets_;
  SessionBySigns& session_;
  const map::KeyFrame& frame_;
  const mapper::View& view_;
  std::string label_;
  std::optional<base::VariableId> offset_variable_;
  KnownOffsets known_offsets_;
  mapper::Batch batch_;
};

SignLandmarksPlugin::SignLandmarksPlugin(const SignLandmarksOptions& options, const mapper::PluginContext& context)
    : options_(options),
      context_(context),
      tracks_(std::make_unique<SignTracks>(context.section)),
      session_(std::make_unique<SessionBySigns>()),
      offsets_(options.pan_tilt_offset_sigma, context.section) {}

SignLandmarksPlugin::~SignLandmarksPlugin() = default;

bool SignLandmarksPlugin::wants(const mrpt::obs::CObservation& observation) const {
  return dynamic_cast<const CObservationDoorSigns*>(&observation) != nullptr &&
         (options_.label.empty() || observation.sensorLabel == options_.label);
}

mapper::Batch SignLandmarksPlugin::measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                                           const mapper::View& view) {
  tracks_->goTo(frame, view, options_.recent_travel);
  return Work(options_, context_, *tracks_, offsets_, *session_, frame, view)
      .take(dynamic_cast<const CObservationDoorSigns&>(observed.observation));
}

void SignLandmarksPlugin::applied(const mapper::AppliedBatch& ids) {
  offsets_.applied(ids);
  for (const auto id : ids.landmarks) tracks_->add(id);
}

mapper::FollowUp SignLandmarksPlugin::afterCommit(const map::KeyFrame&, const mapper::View& view) {
  if (tracks_->fresh.empty()) return {};
  tracks_->update(view);
  return {proposeSameSigns(*tracks_, options_, context_.section, view), {}};
}

mapper::Batch SignLandmarksPlugin::atEnd(const mapper::View& view) {
  if (view.map_is_held) return {};
  tracks_->update(view);
  auto batch = mergeSameSigns(*tracks_, options_, context_.section, view);
  addUnplacedSigns(*tracks_, offsets_, options_, context_.section, view, batch);
  return batch;
}

std::vector<mapper::Evidence> SignLandmarksPlugin::evidence(const mapper::View& view) const {
  return view.map_is_held ? std::vector<mapper::Evidence>()
                          : signEvidence(view, context_.section, options_.recent_travel);
}

void SignLandmarksPlugin::restore(const map::MapSection*, const mapper::View& view) {
  tracks_->restore(view);
}

void SignLandmarksPluginFactory::registerKinds(mapper::Kinds& kinds) const {
  SignBearingFactor::addTo(kinds.factors);
  PanTiltBearingFactor::addTo(kinds.factors);
  SignRangeFactor::addTo(kinds.factors);
  SignPayload::addTo(kinds.payloads);
}

std::unique_ptr<mapper::MeasurementPlugin> SignLandmarksPluginFactory::make(
    const base::ConfigSection& section, const mapper::PluginContext& context) const {
  return std::make_unique<SignLandmarksPlugin>(section.read<SignLandmarksOptions>(mapper::sectionKeysOfEngine()),
                                               context);
}

}  // namespace omnimapper::plugins
