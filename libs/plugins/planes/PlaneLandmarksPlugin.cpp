#include "PlaneLandmarksPlugin.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/landmarks/PlaneFactors.h>
#include <omnimapper/landmarks/PlaneParametrization.h>
#include <omnimapper/landmarks/WallFactor.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/plugin/SessionStart.h>

#include <utility>

#include "PlaneAssociator.h"
#include "PlaneLandmarkIndex.h"
#include "PlaneMerging.h"
#include "SessionByPlanes.h"

IMPLEMENTS_MRPT_OBJECT(PlaneLandmarksPluginFactory, omnimapper::mapper::MeasurementPluginFactory, omnimapper::plugins)

namespace omnimapper::plugins {

const base::OptionTable<PlaneLandmarksOptions>& PlaneLandmarksOptions::table() {
  using Options = PlaneLandmarksOptions;
  using base::Range;
  static const auto table = [] {
    auto own =
        base::OptionTable<Options>()
            .choice("form", &Options::form, {{"plane", Options::Form::plane}, {"wall", Options::Form::wall}},
                    "Kind of landmarks. plane: planes in space. wall: walls as lines on the floor of a planar map, "
                    "measured only by the lines of level lasers.")
            .choice("ground", &Options::ground, {{"start", Options::Ground::start}, {"map", Options::Ground::map}},
                    "Height of the floor, above which a level surface can be a table. start: the height of the base at "
                    "the first key frame. map: z = 0 of the map, for a camera on given poses.")
            .choice("boundary", &Options::boundary,
                    {{"hull", Options::Boundary::hull}, {"seen", Options::Boundary::seen}},
                    "Boundary of a surface in the map. seen: the union of the observed parts, with bays and holes. "
                    "hull: the convex hull of the observed parts.")
            .flag("planes", &Options::planes, "Uses the planes of depth images and clouds.")
            .flag("lines", &Options::lines, "Uses the lines of 2D lasers.")
            .number("min_area_m2", &Options::min_area, Range::notNegative(),
                    "Smallest area of a plane measurement that creates a new landmark.")
            .number("min_length_m", &Options::min_length, Range::notNegative(),
                    "Smallest length of a line measurement that creates a new landmark.")
            .number("max_gap_m", &Options::max_gap, Range::notNegative(),
                    "Largest gap between parts of a wall that belong to one landmark, for laser lines and for surfaces "
                    "that reach higher than 1.5 m above the ground.")
            .number("max_plane_gap_m", &Options::max_plane_gap, Range::notNegative(),
                    "Largest gap between parts of a plane that belong to one landmark, for surfaces that reach no "
                    "higher than 1.5 m above the ground.")
            .number("well_seen_within_m", &Options::well_seen_within, Range::positive(),
                    "Parts of a surface that were measured from farther away than this are drawn only if no part of "
                    "the surface was measured better.")
            .number("well_seen_under_deg", &Options::well_seen_under, Range::positive(),
                    "Parts of a surface that were measured at a larger angle than this between ray and normal are "
                    "drawn only if no part of the surface was measured better.")
            .number("plane_sigma_m", &Options::plane_sigma, Range::notNegative(),
                    "Standard deviation by which a surface deviates from a plane, in addition to the noise that a "
                    "plane measurement reports.")
            .number("plane_angle_sigma_deg", &Options::plane_angle_sigma, Range::notNegative(),
                    "Standard deviation of the normal of a surface, in addition to the noise that a plane "
                    "measurement reports.")
            .number("line_sigma_m", &Options::line_sigma, Range::notNegative(),
                    "Standard deviation by which a wall deviates from a straight line, in addition to the noise that a "
                    "line measurement reports.")
            .number("line_angle_sigma_deg", &Options::line_angle_sigma, Range::notNegative(),
                    "Standard deviation of the direction of a wall, in addition to the noise that a line "
                    "measurement reports.")
            .number("upright_sigma_deg", &Options::upright_sigma, Range::positive(),
                    "Standard deviation of the tilt from upright of a landmark that was measured only by lines at one "
                    "height.")
            .number("loss_scale", &Options::loss_scale, Range::positive(),
                    "Number of standard deviations beyond which a measurement that disagrees loses influence (scale of "
                    "the Huber loss).");
    return declareIn(own);
  }();
  return table;
}

namespace {

constexpr std::size_t kRecentKeyFrames = 60;  // among which a session is searched for

PlanePayload emptyPayload(const PlaneLandmarksOptions& options) {
  PlanePayload empty;
  empty.form = options.form == PlaneLandmarksOptions::Form::wall ? landmarks::PlaneParametrization::Kind::wall
                                                                 : landmarks::PlaneParametrization::Kind::plane;
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
    : options_(options),
      context_(context),
      known_(std::make_unique<PlaneLandmarkIndex>(context.section, emptyPayload(options))),
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

mapper::Batch PlaneLandmarksPlugin::measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                                            const mapper::View& view) {
  known_->update(view);
  const Eigen::Vector3d up_in_base =
      geometry::fromMrpt(mapper::poseOf(view.graph, frame.pose)).rotation.conjugate() * Eigen::Vector3d::UnitZ();
  const auto measurements = planeMeasurements(observed.observation, up_in_base, known_->form(), options_);
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
  auto batch = PlaneAssociator(options_, context_, *known_, frame, view, is_sought).take(measurements);
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
    watch.add(recent, *known_, view, planar);
    return batch;
  }
  watch = PlaneWatch();
  const auto before = search.found();
  const bool is_free = !others_seek_ && mapper::whyFixed({frame.id, {}}, view.graph, view.map).empty();
  const auto place = search.take(frame, recent, *known_, view, planar, is_free);
  if (place) batch.placeSession(*place);
  if (place || search.found() != before) batch.log(aboutSearch(frame, place.has_value(), search.found()));
  return batch;
}

mapper::Decision PlaneLandmarksPlugin::aboutSearch(const map::KeyFrame& frame, bool accepted,
                                                   std::string reason) const {
  mapper::Decision decision;
  decision.stamp = frame.stamp;
  decision.plugin = context_.section;
  decision.kind = mapper::kRelocalization;
  decision.from = frame.id;
  decision.accepted = accepted;
  decision.reason = std::move(reason);
  return decision;
}

PlaneLandmarksPlugin::Says PlaneLandmarksPlugin::aboutSession() const {
  if (session_->recent.size() == 0) return Says::unable;
  if (session_->watch.isContradicted()) return Says::contradicted;
  return session_->watch.isConfirmed() ? Says::confirmed : Says::nothing;
}

void PlaneLandmarksPlugin::applied(const mapper::AppliedBatch& ids) {
  for (const auto id : ids.landmarks) known_->add(id);
}

mapper::FollowUp PlaneLandmarksPlugin::afterCommit(const map::KeyFrame&, const mapper::View& view) {
  session_->watch.endKeyFrame();
  if (view.solves.size() == merged_at_solve_ || view.map_is_held) return {};
  merged_at_solve_ = view.solves.size();
  return {mergeAlike(*known_, options_, context_.section, view), {}};
}

mapper::Batch PlaneLandmarksPlugin::atEnd(const mapper::View& view) {
  return view.map_is_held ? mapper::Batch() : mergeAndJudge(*known_, options_, context_.section, view);
}

std::vector<mapper::Evidence> PlaneLandmarksPlugin::evidence(const mapper::View&) const {
  const auto evidence = session_->watch.evidence();
  return evidence ? std::vector{*evidence} : std::vector<mapper::Evidence>();
}

void PlaneLandmarksPlugin::restore(const map::MapSection*, const mapper::View& view) {
  known_->restore(view);
}

void PlaneLandmarksPluginFactory::registerKinds(mapper::Kinds& kinds) const {
  kinds.factors.add(landmarks::PlaneParametrization::of(landmarks::PlaneParametrization::Kind::plane).variable());
  kinds.factors.add(landmarks::PlaneParametrization::of(landmarks::PlaneParametrization::Kind::wall).variable());
  landmarks::PlaneFactor::addTo(kinds.factors);
  landmarks::LineOnPlaneFactor::addTo(kinds.factors);
  landmarks::UprightFactor::addTo(kinds.factors);
  landmarks::WallFactor::addTo(kinds.factors);
  PlanePayload::addTo(kinds.payloads);
}

std::unique_ptr<mapper::MeasurementPlugin> PlaneLandmarksPluginFactory::make(
    const base::ConfigSection& section, const mapper::PluginContext& context) const {
  return std::make_unique<PlaneLandmarksPlugin>(section.read<PlaneLandmarksOptions>(mapper::sectionKeysOfEngine()),
                                                context);
}

}  // namespace omnimapper::plugins
