#include "PointAssociator.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <cmath>

#include "PointPayload.h"

namespace omnimapper::plugins {

PointAssociator::PointAssociator(const PointLandmarksOptions& options, const mapper::PluginContext& context,
                                 const PointLandmarkIndex& known, const map::KeyFrame& frame, const mapper::View& view,
                                 std::string label)
    : LandmarkAssociator(options, context.section, frame, view),
      options_(options),
      context_(context),
      known_(known),
      map_from_base_(geometry::fromMrpt(mapper::poseOf(view.graph, frame.pose))),
      label_(std::move(label)) {}

void PointAssociator::describe(const PointMeasurement& measurement, mapper::Decision& decision) const {
  decision.kind = "point measurement";
  if (measurement.number >= 0) decision.numbers.emplace_back("number", measurement.number);
  decision.numbers.emplace_back("range [m]", measurement.range);
}

std::vector<base::LandmarkId> PointAssociator::candidates(const PointMeasurement& measurement) {
  if (isIdentified(measurement)) {
    const auto* known = known_.newest([&](const KnownPoint& each) { return each.number == measurement.number; });
    return known ? std::vector{known->id} : std::vector<base::LandmarkId>();
  }
  std::vector<base::LandmarkId> near;
  for (const auto& [id, known] : known_.all())
    if (isNear(*measurement.constraint, known.variable)) near.push_back(id);
  return near;
}

bool PointAssociator::isNear(const PointConstraint& constraint, base::VariableId variable) {
  constexpr double kNear = 0.5, kSigmas = 5;  // [m]
  const Eigen::VectorXd& there = view().graph.value(variable);
  Eigen::Vector3d gap = map_from_base_ * constraint.point_in_base;
  for (int i = 0; i < 3; ++i) gap[i] = i < there.size() ? there[i] - gap[i] : 0;
  const double own = kNear + 2 * kSigmas * constraint.sigma;
  return gap.norm() <= own || gap.norm() <= own + kSigmas * poseSigma(constraint.point_in_base.norm());
}

double PointAssociator::poseSigma(double range) {
  if (!pose_variances_) {
    const auto pose = view().jointCovariance({frame().pose});
    const Eigen::Index places = pose && pose->rows() == 6 ? 3 : 2;
    pose_variances_ =
        pose ? std::pair(pose->diagonal().head(places).sum(), pose->diagonal().tail(pose->rows() - places).sum())
             : std::pair(0.0, 0.0);
  }
  return std::sqrt(pose_variances_->first + range * range * pose_variances_->second);
}

graph::FactorRecord PointAssociator::record(const PointMeasurement& measurement, base::VariableId point) const {
  graph::FactorRecord record{{frame().pose, point}, measurement.constraint->factor, measurement.constraint->noise};
  record.loss = graph::Loss::huber(options_.loss_scale);
  record.tags.note = "point measurement";
  return record;
}

std::shared_ptr<const map::LandmarkPayload> PointAssociator::learned(const PointMeasurement& measurement,
                                                                     const landmarks::LandmarkIds& known) {
  return payloadOf<PointPayload>(known.landmark).with(label_, measurement.constraint->point_in_base.z());
}

void PointAssociator::addNew(const PointMeasurement& measurement, mapper::Decision decision) {
  const Eigen::Vector3d in_base = measurement.constraint->point_in_base, in_map = map_from_base_ * in_base;
  const bool planar = context_.motion == mapper::Motion::planar;
  PointPayload payload;
  payload.number = measurement.number;
  addLandmark(measurement, std::move(decision),
              {isIdentified(measurement) ? "marker" : "point", planar ? graph::point2() : graph::point3(),
               in_map.head(planar ? 2 : 3), payload.with(label_, in_base.z())});
}

}  // namespace omnimapper::plugins
