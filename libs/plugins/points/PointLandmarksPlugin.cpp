#include "PointLandmarksPlugin.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/landmarks/InterSessionHypothesis.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "PointLandmarkIndex.h"
#include "PointMeasurement.h"
#include "PointMerging.h"
#include "PointPayload.h"
#include "RangeBearingFactor.h"

IMPLEMENTS_MRPT_OBJECT(PointLandmarksPluginFactory, omnimapper::mapper::MeasurementPluginFactory, omnimapper::plugins)

namespace omnimapper::plugins {

using mrpt::obs::CObservationBearingRange;

const base::OptionTable<PointLandmarksOptions>& PointLandmarksOptions::table() {
  using Options = PointLandmarksOptions;
  using base::Range;
  static const auto table = [] {
    auto own =
        base::OptionTable<Options>()
            .text("label", &Options::label, "Sensor label of the range-bearing sensor; empty for every such sensor.")
            .number("sigma_range_m", &Options::sigma_range, Range::notNegative(),
                    "Standard deviation of a measured range; 0 uses the value that the observation reports.")
            .number("sigma_yaw_deg", &Options::sigma_yaw, Range::notNegative(),
                    "Standard deviation of a measured yaw; 0 uses the value that the observation reports.")
            .number("sigma_pitch_deg", &Options::sigma_pitch, Range::notNegative(),
                    "Standard deviation of a measured pitch; 0 uses the value that the observation reports.")
            .number("loss_scale", &Options::loss_scale, Range::positive(),
                    "Number of standard deviations beyond which a measurement that disagrees loses influence (scale of "
                    "the Huber loss).");
    return declareIn(own);
  }();
  return table;
}

// Associates the measurements of one observation and makes the edits of graph and map.
class PointLandmarksPlugin::Associator {
 public:
  Associator(const PointLandmarksOptions& options, const mapper::PluginContext& context,
             const PointLandmarkIndex& known, const map::KeyFrame& frame, const mapper::View& view)
      : options_(options),
        context_(context),
        known_(known),
        frame_(frame),
        view_(view),
        map_from_base_(geometry::fromMrpt(mapper::poseOf(view.graph, frame.pose))) {}

  mapper::Batch take(const CObservationBearingRange& observation) {
    label_ = observation.sensorLabel;
    const auto measurements = pointMeasurements(observation, context_.motion, options_);
    std::vector<const PointMeasurement*> numbered, unnumbered;
    for (const auto& measured : measurements) {
      if (measured.constraint) {
        (measured.number < 0 ? unnumbered : numbered).push_back(&measured);
      } else {
        mapper::Decision decision = decisionOf(measured);
        decision.reason = measured.why_useless;
        batch_.log(std::move(decision));
      }
    }
    takeNumbered(numbered);
    takeUnnumbered(unnumbered);
    return std::move(batch_);
  }

 private:
  // A measurement with a number has only one candidate, so no joint association is needed.
  void takeNumbered(const std::vector<const PointMeasurement*>& measurements) {
    std::vector<mapper::Pairing> pairings;
    for (std::size_t i = 0; i < measurements.size(); ++i) {
      const auto id = known_.ofNumber(measurements[i]->number);
      if (id) pairings.push_back({i, *id, record(*measurements[i]->constraint, known_.variableOf(*id), *id)});
    }
    mapper::AssociationOptions options = options_;
    options.method = mapper::AssociationOptions::Method::nearest;
    const auto found = mapper::associate(measurements.size(), pairings, view_, options, mapper::Repeats::no);
    for (std::size_t i = 0; i < measurements.size(); ++i) {
      const auto& match = found.matches[i];
      mapper::Decision decision = decisionOf(*measurements[i]);
      found.describe(i, decision);
      if (!match.pairing) {
        addNew(*measurements[i], std::move(decision));
        continue;
      }
      const mapper::Pairing& pairing = pairings[*match.pairing];
      met_.insert(pairing.landmark);
      if (match.kind == mapper::Match::Kind::matched ||
          !view_.areAligned(frame_.id.session, pairing.landmark.session)) {
        addToKnown(*measurements[i], pairing, std::move(decision));
      } else {
        keepWithoutWeight(pairing, std::move(decision));
      }
    }
  }

  void takeUnnumbered(const std::vector<const PointMeasurement*>& measurements) {
    if (measurements.empty()) return;
    std::vector<mapper::Pairing> pairings;
    for (std::size_t i = 0; i < measurements.size(); ++i) {
      const PointConstraint& constraint = *measurements[i]->constraint;
      for (const auto& [id, variable] : known_.all()) {
        if (met_.count(id) == 0 && mayBe(constraint, variable))
          pairings.push_back({i, id, record(constraint, variable, id)});
      }
    }
    const auto found = mapper::associate(measurements.size(), pairings, view_, options_, mapper::Repeats::no);
    for (std::size_t i = 0; i < measurements.size(); ++i) {
      const auto& match = found.matches[i];
      mapper::Decision decision = decisionOf(*measurements[i]);
      found.describe(i, decision);
      if (match.pairing) decision.numbers.emplace_back("landmark", pairings[*match.pairing].landmark.index);
      if (match.kind == mapper::Match::Kind::matched) {
        addToKnown(*measurements[i], pairings[*match.pairing], std::move(decision));
      } else if (match.kind == mapper::Match::Kind::unknown) {
        addNew(*measurements[i], std::move(decision));
      } else {
        batch_.log(std::move(decision));
      }
    }
  }

  // A coarse preselection; the gate decides which landmarks are near enough.
  bool mayBe(const PointConstraint& constraint, base::VariableId variable) {
    constexpr double kNear = 0.5, kSigmas = 5;  // [m]
    const Eigen::VectorXd& there = view_.graph.value(variable);
    Eigen::Vector3d gap = map_from_base_ * constraint.point_in_base;
    for (int i = 0; i < 3; ++i) gap[i] = i < there.size() ? there[i] - gap[i] : 0;
    const double own = kNear + 2 * kSigmas * constraint.sigma;
    return gap.norm() <= own || gap.norm() <= own + kSigmas * poseSigma(constraint.point_in_base.norm());
  }

  // Standard deviation [m] of a point at this distance [m] from the base, due to the uncertainty of the base's pose.
  double poseSigma(double range) {
    if (!pose_variances_) {
      const auto pose = view_.jointCovariance({frame_.pose});
      const Eigen::Index places = pose && pose->rows() == 6 ? 3 : 2;
      pose_variances_ =
          pose ? std::pair(pose->diagonal().head(places).sum(), pose->diagonal().tail(pose->rows() - places).sum())
               : std::pair(0.0, 0.0);
    }
    return std::sqrt(pose_variances_->first + range * range * pose_variances_->second);
  }

  graph::FactorRecord record(const PointConstraint& constraint, base::VariableId point,
                             base::LandmarkId landmark) const {
    graph::FactorRecord record{{frame_.pose, point}, constraint.factor, constraint.noise};
    record.loss = graph::Loss::huber(options_.loss_scale);
    record.tags.owner = context_.section;
    record.tags.landmark = landmark;
    record.tags.note = "point measurement";
    return record;
  }

  mapper::Decision decisionOf(const PointMeasurement& measured) const {
    mapper::Decision decision;
    decision.stamp = frame_.stamp;
    decision.plugin = context_.section;
    decision.kind = "point measurement";
    decision.from = frame_.id;
    if (measured.number >= 0) decision.numbers.emplace_back("number", measured.number);
    decision.numbers.emplace_back("range [m]", measured.range);
    return decision;
  }

  void addToKnown(const PointMeasurement& measured, const mapper::Pairing& pairing, mapper::Decision decision) {
    if (landmarks::addInterSessionHypothesis(view_, frame_.id, pairing, decision, batch_)) return;
    batch_.log(std::move(decision));
    batch_.addFactor(pairing.record);
    const auto& payload = dynamic_cast<const PointPayload&>(*view_.map.landmark(pairing.landmark).payload);
    batch_.addEvidence(pairing.landmark, payload.with(label_, measured.constraint->point_in_base.z()));
  }

  // The number of the measurement is that of this landmark, but the position does not fit: the landmark may have moved.
  void keepWithoutWeight(const mapper::Pairing& pairing, mapper::Decision decision) {
    decision.reason = "gated out: not where its landmark is; kept without weight";
    batch_.log(std::move(decision));
    graph::FactorRecord elsewhere = pairing.record;
    elsewhere.weight = 0;
    batch_.addFactor(std::move(elsewhere));
  }

  void addNew(const PointMeasurement& measured, mapper::Decision decision) {
    if (view_.map_is_held) {
      decision.reason = "not in the map: " + decision.reason;
      return batch_.log(std::move(decision));
    }
    decision.accepted = true;
    decision.reason = "new: " + decision.reason;
    batch_.log(std::move(decision));
    const PointConstraint& constraint = *measured.constraint;
    const Eigen::Vector3d point = map_from_base_ * constraint.point_in_base;
    const bool planar = context_.motion == mapper::Motion::planar;
    const auto variable =
        planar ? batch_.addVariable(graph::point2(), point.head<2>()) : batch_.addVariable(graph::point3(), point);
    PointPayload payload;
    payload.number = measured.number;
    const auto landmark = batch_.addLandmark(measured.number < 0 ? "point" : "marker", {variable},
                                             payload.with(label_, constraint.point_in_base.z()));
    batch_.addFactor(record(constraint, variable, landmark));
  }

  const PointLandmarksOptions& options_;
  const mapper::PluginContext& context_;
  const PointLandmarkIndex& known_;
  const map::KeyFrame& frame_;
  const mapper::View& view_;
  geometry::Se3 map_from_base_;
  std::string label_;
  std::optional<std::pair<double, double>> pose_variances_;  // of the position [m^2], of the rotation [rad^2]
  std::set<base::LandmarkId> met_;
  mapper::Batch batch_;
};

PointLandmarksPlugin::PointLandmarksPlugin(const PointLandmarksOptions& options, const mapper::PluginContext& context)
    : options_(options), context_(context), known_(std::make_unique<PointLandmarkIndex>(context.section)) {}

PointLandmarksPlugin::~PointLandmarksPlugin() = default;

bool PointLandmarksPlugin::wants(const mrpt::obs::CObservation& observation) const {
  return dynamic_cast<const CObservationBearingRange*>(&observation) &&
         (options_.label.empty() || observation.sensorLabel == options_.label);
}

mapper::Batch PointLandmarksPlugin::measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                                            const mapper::View& view) {
  known_->update(view);
  return Associator(options_, context_, *known_, frame, view)
      .take(dynamic_cast<const CObservationBearingRange&>(observed.observation));
}

void PointLandmarksPlugin::applied(const mapper::AppliedBatch& ids) {
  for (const auto id : ids.landmarks) known_->add(id);
}

mapper::FollowUp PointLandmarksPlugin::afterCommit(const map::KeyFrame&, const mapper::View& view) {
  if (view.solves.size() == merged_at_solve_) return {};
  merged_at_solve_ = view.solves.size();
  return {atEnd(view), {}};
}

mapper::Batch PointLandmarksPlugin::atEnd(const mapper::View& view) {
  if (view.map_is_held) return {};
  known_->update(view);
  return mergeAlike(*known_, options_, context_.section, view);
}

void PointLandmarksPlugin::restore(const map::MapSection*, const mapper::View& view) {
  known_->restore(view);
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
