#include "PlaneLandmarksPlugin.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/plane_factors/PlaneFactors.h>
#include <omnimapper/plane_factors/PlaneParametrization.h>
#include <omnimapper/plane_factors/WallFactor.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/plugin/SessionStart.h>

#include <utility>

#include "PlaneAssociator.h"
#include "PlaneMerging.h"
#include "SessionByPlanes.h"

namespace omnimapper::plugins {

namespace {

constexpr std::size_t kRecentKeyFrames = 60;  // among which a session is searched for

PlanePayload emptyPayload(const PlaneLandmarksOptions& options) {
  PlanePayload empty;
  empty.form = options.form == PlaneLandmarksOptions::Form::wall ? plane_factors::PlaneParametrization::Kind::wall
                                                                 : plane_factors::PlaneParametrization::Kind::plane;
  empty.ground = options.ground;
  empty.boundary = options.boundary;
  return empty;
}

}  // namespace

// What the plugin knows of where the newest session lies in the map.
struct PlaneSession {
  RecentSurfaces recent;
  SessionByPlanes search;
  PlaneWatch watch;
};

PlaneLandmarksPlugin::PlaneLandmarksPlugin(const PlaneLandmarksOptions& options, const mapper::PluginContext& context)
    : LandmarkPlugin(PlaneLandmarkIndex(context.section, emptyPayload(options))),
      options_(options),
      context_(context),
      session_(std::make_unique<PlaneSession>()) {
  if (options.form != PlaneLandmarksOptions::Form::wall) return;
  options_.planes = false;
  if (context.motion == mapper::Motion::planar) return;
  throw base::Error(base::ExitCode::out_of_range,
                    "[" + context.section +
                        "] form = wall needs [mapper] motion = planar; for a map in space "
                        "set form = plane");
}

PlaneLandmarksPlugin::~PlaneLandmarksPlugin() = default;

bool PlaneLandmarksPlugin::wants(const mrpt::obs::CObservation& observation) const {
  return (options_.planes && dynamic_cast<const obs::CObservationPlanes*>(&observation)) ||
         (options_.lines && dynamic_cast<const obs::CObservationLaserLines*>(&observation));
}

mapper::Batch PlaneLandmarksPlugin::associate(const map::KeyFrame& frame, const mapper::Observed& observed,
                                              const mapper::View& view) {
  const Eigen::Vector3d up_in_base =
      geometry::fromMrpt(mapper::poseOf(view.graph, frame.pose)).rotation.conjugate() * Eigen::Vector3d::UnitZ();
  const auto measurements = planeMeasurements(observed.observation, up_in_base, known().form(), options_);
  mapper::Batch of_session;
  if (view.map.sessions.size() > 1 && frame.id.session == view.map.sessions.back().number) {
    mrpt::poses::CPose3D base_from_sensor;
    observed.observation.getSensorPose(base_from_sensor);
    of_session = watchSession(frame, measurements, geometry::fromMrpt(base_from_sensor).translation, view);
    if (of_session.sessionPlace()) return of_session;
  }
  // A run that only localizes and knows roughly where it starts must be located soon; a wrong association harms no map
  // there.
  const bool is_sought = session_->search.isLost() || (others_seek_ && !view.map_is_held);
  auto batch = PlaneAssociator(options_, context_.section, known(), frame, view, is_sought).take(measurements);
  for (const auto& decision : of_session.decisions()) batch.log(decision);
  return batch;
}

mapper::Batch PlaneLandmarksPlugin::watchSession(const map::KeyFrame& frame,
                                                 const std::vector<PlaneMeasurement>& measurements,
                                                 const Eigen::Vector3d& sensor_in_base, const mapper::View& view) {
  auto& [recent, search, watch] = *session_;
  const bool planar = context_.motion == mapper::Motion::planar;
  mapper::Batch batch;
  if (!recent.add(frame, measurements, sensor_in_base)) return batch;
  recent.keep(kRecentKeyFrames);
  if (view.map.sessions.back().aligned) {
    watch.add(recent, known(), view, planar);
    return batch;
  }
  watch = PlaneWatch();
  const auto before = search.found();
  const bool is_free = !others_seek_ && mapper::whyFixed({frame.id, {}}, view.graph, view.map).empty();
  const auto place = search.take(frame, recent, known(), view, planar, is_free);
  if (place) batch.placeSession(*place);
  if (place || search.found() != before) batch.log(aboutSearch(frame, place.has_value(), search.found()));
  return batch;
}

mapper::Decision PlaneLandmarksPlugin::aboutSearch(const map::KeyFrame& frame, bool accepted,
                                                   std::string reason) const {
  mapper::Decision decision(frame, context_.section, mapper::kRelocalization);
  decision.accepted = accepted;
  decision.reason = std::move(reason);
  return decision;
}

PlaneLandmarksPlugin::Says PlaneLandmarksPlugin::aboutSession() const {
  if (session_->recent.size() == 0) return Says::unable;
  if (session_->watch.isContradicted()) return Says::contradicted;
  return session_->watch.isConfirmed() ? Says::confirmed : Says::nothing;
}

mapper::FollowUp PlaneLandmarksPlugin::afterCommit(const map::KeyFrame& frame, const mapper::View& view) {
  session_->watch.endKeyFrame();
  return LandmarkPlugin::afterCommit(frame, view);
}

mapper::Batch PlaneLandmarksPlugin::merge(const mapper::View& view) {
  return mergeAlike(known(), options_, context_.section, view);
}

mapper::Batch PlaneLandmarksPlugin::finish(const mapper::View& view) {
  return mergeAndJudge(known(), options_, context_.section, view);
}

std::vector<mapper::Evidence> PlaneLandmarksPlugin::evidence(const mapper::View&) const {
  const auto evidence = session_->watch.evidence();
  return evidence ? std::vector{*evidence} : std::vector<mapper::Evidence>();
}

void PlaneLandmarksPlugin::registerKinds(mapper::Kinds& kinds) {
  kinds.factors.add(
      plane_factors::PlaneParametrization::of(plane_factors::PlaneParametrization::Kind::plane).variable());
  kinds.factors.add(
      plane_factors::PlaneParametrization::of(plane_factors::PlaneParametrization::Kind::wall).variable());
  plane_factors::PlaneFactor::addTo(kinds.factors);
  plane_factors::LineOnPlaneFactor::addTo(kinds.factors);
  plane_factors::UprightFactor::addTo(kinds.factors);
  plane_factors::WallFactor::addTo(kinds.factors);
  PlanePayload::addTo(kinds.payloads);
}

}  // namespace omnimapper::plugins
