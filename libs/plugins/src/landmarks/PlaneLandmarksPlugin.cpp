#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/mapper/PoseFactors.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/plugins/PlaneLandmarksPlugin.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "KnownPlanes.h"
#include "PlaneFactors.h"
#include "PlaneMerging.h"
#include "SurfaceForm.h"
#include "WallFactor.h"

IMPLEMENTS_MRPT_OBJECT(PlaneLandmarksPluginFactory, omnimapper::mapper::MeasurementPluginFactory, omnimapper::plugins)

namespace omnimapper::plugins {

using geometry::Plane3;
using geometry::Se3;

const base::OptionTable<PlaneLandmarksOptions>& PlaneLandmarksOptions::table() {
  using Options = PlaneLandmarksOptions;
  using base::Range;
  static const auto table = [] {
    auto own =
        base::OptionTable<Options>()
            .choice("form", &Options::form, {{"plane", Options::Form::plane}, {"wall", Options::Form::wall}},
                    "What is optimised: planes in space, or, in a planar map with level lasers, walls as lines on the "
                    "floor. Of walls only lines are taken.")
            .flag("planes", &Options::planes, "Take the planes of depth images and clouds.")
            .flag("lines", &Options::lines, "Take the lines of 2D lasers.")
            .number("min_area_m2", &Options::min_area, Range::notNegative(),
                    "A new landmark seen as a plane is so large.")
            .number("min_length_m", &Options::min_length, Range::notNegative(),
                    "A new landmark seen as a line is so long.")
            .number("max_gap_m", &Options::max_gap, Range::notNegative(),
                    "Surfaces on one plane that are so far apart are landmarks of their own.")
            .number("plane_sigma_m", &Options::plane_sigma, Range::notNegative(),
                    "Standard deviation of a surface from flat, beside the noise that an observed plane tells of.")
            .number("plane_angle_sigma_deg", &Options::plane_angle_sigma, Range::notNegative(),
                    "The same of its normal.")
            .number("line_sigma_m", &Options::line_sigma, Range::notNegative(),
                    "Standard deviation of a wall from straight, beside the noise that an observed line tells of.")
            .number("line_angle_sigma_deg", &Options::line_angle_sigma, Range::notNegative(),
                    "The same of its direction.")
            .number("upright_sigma_deg", &Options::upright_sigma, Range::positive(),
                    "What is seen as lines of one height only is upright, with this standard deviation.")
            .number("loss_scale", &Options::loss_scale, Range::positive(),
                    "Scale of the Huber loss, in standard deviations.");
    return declareIn(own);
  }();
  return table;
}

// The work on one observation.
class PlaneLandmarksPlugin::Moment {
 public:
  Moment(const PlaneLandmarksOptions& options, const mapper::PluginContext& context, const KnownPlanes& known,
         const map::KeyFrame& frame, const mapper::View& view)
      : options_(options),
        context_(context),
        known_(known),
        form_(known.form()),
        frame_(frame),
        view_(view),
        map_from_base_(geometry::fromMrpt(mapper::poseOf(view.graph, frame.pose))) {
    const auto pose = view.jointCovariance({frame.pose});
    if (pose) pose_sigma_ = std::sqrt(pose->topLeftCorner<2, 2>().trace());
  }

  Eigen::Vector3d upInBase() const { return map_from_base_.rotation.conjugate() * Eigen::Vector3d::UnitZ(); }

  mapper::Batch take(const std::vector<PlaneSighting>& sightings) {
    const auto pairings = pairingsOf(sightings);
    const auto found = mapper::associate(sightings.size(), pairings, view_, options_, mapper::Repeats::yes);
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const auto& match = found.matches[i];
      mapper::Decision decision = decisionOf(sightings[i]);
      match.tell(decision);
      if (match.pairing) decision.numbers.emplace_back("landmark", pairings[*match.pairing].landmark.index);
      if (match.kind == mapper::Match::Kind::matched || spansTwo(match, pairings)) {
        decision.accepted = true;
        addToKnown(sightings[i], pairings[*match.pairing], std::move(decision));
      } else if (match.kind == mapper::Match::Kind::unknown) {
        addNew(sightings[i], std::move(decision));
      } else {
        batch_.log(std::move(decision));
      }
    }
    return std::move(batch_);
  }

 private:
  struct Fresh {
    base::LandmarkId id;
    base::VariableId variable;
    Plane3 plane;
    std::vector<Eigen::Vector2d> hull;
  };

  std::vector<mapper::Pairing> pairingsOf(const std::vector<PlaneSighting>& sightings) {
    std::vector<mapper::Pairing> pairings;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const Plane3 plane = map_from_base_ * sightings[i].plane_in_base;
      const auto points = inMap(sightings[i].outline_in_base);
      const auto add = [&](const KnownPlanes::Surface& surface) {
        pairings.push_back({i, surface.id, record(sightings[i], surface.variable, surface.id)});
      };
      std::vector<std::pair<double, const KnownPlanes::Surface*>> apart;
      for (const auto& [id, surface] : known_.all()) {
        const auto gap = gapIfAlike(surface, plane, points);
        if (!gap) continue;
        if (*gap <= options_.max_gap) {
          add(surface);
        } else {
          apart.emplace_back(*gap, &surface);
        }
      }
      // Farther ones where the base may have slid along the wall since it saw them; beyond one that is too far, none.
      std::stable_sort(apart.begin(), apart.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      for (const auto& [gap, surface] : apart) {
        if (gap > options_.max_gap + 3 * sigmaSince(surface->last_seen_from)) break;
        add(*surface);
      }
    }
    return pairings;
  }

  // Of two landmarks on one plane, say on both sides of a door: each is as right, and now they touch.
  bool spansTwo(const mapper::Match& match, const std::vector<mapper::Pairing>& pairings) const {
    if (match.kind != mapper::Match::Kind::ambiguous) return false;
    const auto& all = known_.all();
    return onOnePlane(all.at(pairings[*match.pairing].landmark), all.at(*match.rival));
  }

  // How far apart they are on their plane, if they may be one. Wide open: what is near enough is for the covariance to
  // say.
  std::optional<double> gapIfAlike(const KnownPlanes::Surface& surface, const Plane3& plane,
                                   const std::vector<Eigen::Vector3d>& points) const {
    constexpr double kAlong = 0.8, kFarthest = 0.5;  // cosine of the turn, [m]
    if (surface.plane.normal.dot(plane.normal) < kAlong) return std::nullopt;
    const double reach = kFarthest + 4 * pose_sigma_;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto& point : points) middle += point / static_cast<double>(points.size());
    if (std::abs(signedDistance(surface.plane, middle)) > reach) return std::nullopt;
    const double gap = gapBetween(surface, points);
    if (gap > options_.max_gap + 3 * pose_sigma_) return std::nullopt;
    return gap;
  }

  // [m] of the way since then.
  double sigmaSince(base::KeyFrameId frame) {
    const auto [found, is_new] = sigma_since_.try_emplace(frame, 0);
    if (is_new) {
      const auto motion = view_.covarianceBetween(frame, frame_.id);
      if (motion) found->second = std::sqrt(motion->topLeftCorner<3, 3>().trace());
    }
    return found->second;
  }

  std::vector<Eigen::Vector3d> inMap(const std::vector<Eigen::Vector3d>& in_base) const {
    std::vector<Eigen::Vector3d> points;
    for (const auto& point : in_base) points.push_back(map_from_base_ * point);
    return points;
  }

  graph::FactorRecord record(const PlaneSighting& sighting, base::VariableId plane, base::LandmarkId landmark) const {
    graph::FactorRecord record{{frame_.pose, plane}, sighting.factor, sighting.noise};
    record.loss = graph::Loss::huber(options_.loss_scale);
    record.tags.owner = context_.section;
    record.tags.landmark = landmark;
    record.tags.note = sighting.is_line ? "line of a laser" : "plane";
    return record;
  }

  mapper::Decision decisionOf(const PlaneSighting& sighting) const {
    mapper::Decision decision;
    decision.stamp = frame_.stamp;
    decision.plugin = context_.section;
    decision.kind = sighting.is_line ? "line of a wall" : "plane";
    decision.from = frame_.id;
    decision.numbers = {{sighting.is_line ? "length [m]" : "area [m^2]", sighting.size}};
    return decision;
  }

  void addToKnown(const PlaneSighting& sighting, const mapper::Pairing& pairing, mapper::Decision decision) {
    const base::LandmarkId id = pairing.landmark;
    if (!isJoined(id)) {
      // The first thing that ties this session to the map: if it were wrong, everything would be.
      decision.accepted = false;
      decision.reason = "waits for the consistency test";
      batch_.addHypothesis(pairing.record, std::move(decision));
      return;
    }
    batch_.log(std::move(decision));
    batch_.addFactor(pairing.record);
    // A landmark may be met twice in a moment: the second time goes on from what the first made of it.
    auto& payload = payloads_[id];
    if (!payload) payload = std::dynamic_pointer_cast<const PlanePayload>(view_.map.landmark(id).payload);
    if (!sighting.is_line && !payload->wasSeenAsPlane()) {
      if (const auto upright = uprightFactor(view_.graph, pairing.record.variables.back()))
        batch_.removeFactor(*upright);
    }
    const bool tells_more = reachesOver(known_.all().at(id), inMap(sighting.outline_in_base));
    payload = payload->with(frame_.id, sighting, tells_more);
    batch_.addEvidence(id, payload);
  }

  // Whether a corner lies outside by more than edges are seen alike.
  static bool reachesOver(const KnownPlanes::Surface& surface, const std::vector<Eigen::Vector3d>& points) {
    constexpr double kEdge = 0.05;  // [m]
    return std::any_of(points.begin(), points.end(),
                       [&](const Eigen::Vector3d& point) { return gapBetween(surface, {point}) > kEdge; });
  }

  bool isJoined(base::LandmarkId landmark) const {
    if (landmark.session == frame_.id.session) return true;
    const auto& sessions = view_.map.sessions;
    return std::all_of(sessions.begin(), sessions.end(),
                       [&](const auto& session) { return session.number != frame_.id.session || session.joined; });
  }

  void addNew(const PlaneSighting& sighting, mapper::Decision decision) {
    const Plane3 plane = map_from_base_ * sighting.plane_in_base;
    const auto points = inMap(sighting.outline_in_base);
    if (const Fresh* same = alikeInThisMoment(plane, points)) {
      decision.accepted = true;
      decision.reason = "of a new landmark seen twice at once";
      batch_.log(std::move(decision));
      batch_.addFactor(record(sighting, same->variable, same->id));
      return;
    }
    const bool large = sighting.size >= (sighting.is_line ? options_.min_length : options_.min_area);
    decision.accepted = large;
    decision.reason = (large ? "new: " : "too small for a new one: ") + decision.reason;
    batch_.log(std::move(decision));
    if (!large) return;
    const auto variable = batch_.addVariable(form_.variable(), form_.value(plane, points));
    const auto landmark =
        batch_.addLandmark("plane", {variable}, known_.emptyPayload().with(frame_.id, sighting, true));
    batch_.addFactor(record(sighting, variable, landmark));
    if (sighting.is_line && form_.mayLean()) {
      graph::FactorRecord upright{
          {variable},
          std::make_shared<UprightFactor>(),
          graph::SquareRootInformation::fromSigmas(Eigen::VectorXd::Constant(1, options_.upright_sigma))};
      upright.tags.owner = context_.section;
      upright.tags.landmark = landmark;
      upright.tags.note = "upright";
      batch_.addFactor(upright);
    }
    fresh_.push_back({landmark, variable, plane, hullOn(PlaneAxes(plane), points)});
  }

  // Two stretches of one wall, with a door between them.
  const Fresh* alikeInThisMoment(const Plane3& plane, const std::vector<Eigen::Vector3d>& points) const {
    constexpr double kTurn = 0.05, kOff = 0.05;  // [rad], [m]
    for (const Fresh& fresh : fresh_) {
      KnownPlanes::Surface surface;
      surface.plane = fresh.plane;
      surface.hull = fresh.hull;
      const bool off = std::any_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
        return std::abs(signedDistance(fresh.plane, point)) > kOff;
      });
      if (!off && fresh.plane.normal.cross(plane.normal).norm() < kTurn && fresh.plane.normal.dot(plane.normal) > 0 &&
          gapBetween(surface, points) <= options_.max_gap)
        return &fresh;
    }
    return nullptr;
  }

  const PlaneLandmarksOptions& options_;
  const mapper::PluginContext& context_;
  const KnownPlanes& known_;
  const SurfaceForm& form_;
  const map::KeyFrame& frame_;
  const mapper::View& view_;
  Se3 map_from_base_;
  double pose_sigma_ = 0;                           // [m] of the base in the map
  std::map<base::KeyFrameId, double> sigma_since_;  // [m]
  std::vector<Fresh> fresh_;
  std::map<base::LandmarkId, std::shared_ptr<const PlanePayload>> payloads_;  // of those that were met
  mapper::Batch batch_;
};

PlaneLandmarksPlugin::PlaneLandmarksPlugin(const PlaneLandmarksOptions& options, const mapper::PluginContext& context)
    : options_(options),
      context_(context),
      known_(std::make_unique<KnownPlanes>(context.section, options.form == PlaneLandmarksOptions::Form::wall
                                                                ? SurfaceForm::Kind::wall
                                                                : SurfaceForm::Kind::plane)) {
  if (options.form != PlaneLandmarksOptions::Form::wall) return;
  options_.planes = false;
  if (context.motion == mapper::Motion::planar) return;
  throw base::Error(base::ExitCode::out_of_range,
                    "[" + context.section +
                        "] form = wall needs [mapper] motion = planar; for a map in space "
                        "take form = plane");
}

PlaneLandmarksPlugin::~PlaneLandmarksPlugin() = default;

bool PlaneLandmarksPlugin::wants(const mrpt::obs::CObservation& observation) const {
  return (options_.planes && dynamic_cast<const obs::CObservationPlanes*>(&observation)) ||
         (options_.lines && dynamic_cast<const obs::CObservationLaserLines*>(&observation));
}

mapper::Batch PlaneLandmarksPlugin::measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                                            const mapper::View& view) {
  known_->update(view);
  Moment moment(options_, context_, *known_, frame, view);
  return moment.take(planeSightings(observed.observation, moment.upInBase(), known_->form(), options_));
}

void PlaneLandmarksPlugin::applied(const mapper::AppliedBatch& ids) {
  for (const auto id : ids.landmarks) known_->add(id);
}

mapper::FollowUp PlaneLandmarksPlugin::afterCommit(const map::KeyFrame&, const mapper::View& view) {
  if (view.solves.size() == merged_at_solve_ || view.map_is_held) return {};
  merged_at_solve_ = view.solves.size();
  return {mergeAlike(*known_, options_, context_.section, view), {}};
}

mapper::Batch PlaneLandmarksPlugin::atEnd(const mapper::View& view) {
  return view.map_is_held ? mapper::Batch() : mergeAlike(*known_, options_, context_.section, view);
}

void PlaneLandmarksPlugin::restore(const map::MapSection*, const mapper::View& view) {
  known_->restore(view);
}

void PlaneLandmarksPluginFactory::registerKinds(mapper::Kinds& kinds) const {
  kinds.factors.add(SurfaceForm::of(SurfaceForm::Kind::plane).variable());
  kinds.factors.add(SurfaceForm::of(SurfaceForm::Kind::wall).variable());
  PlaneFactor::addTo(kinds.factors);
  LineOnPlaneFactor::addTo(kinds.factors);
  UprightFactor::addTo(kinds.factors);
  WallFactor::addTo(kinds.factors);
  PlanePayload::addTo(kinds.payloads);
}

std::unique_ptr<mapper::MeasurementPlugin> PlaneLandmarksPluginFactory::make(
    const base::ConfigSection& section, const mapper::PluginContext& context) const {
  return std::make_unique<PlaneLandmarksPlugin>(section.read<PlaneLandmarksOptions>(mapper::sectionKeysOfEngine()),
                                                context);
}

}  // namespace omnimapper::plugins
