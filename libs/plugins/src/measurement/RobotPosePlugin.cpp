#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/mapper/PoseFactors.h>
#include <omnimapper/plugins/RobotPosePlugin.h>

#include <sstream>

#include "SavedVariable.h"

IMPLEMENTS_MRPT_OBJECT(RobotPosePluginFactory, omnimapper::mapper::MeasurementPluginFactory, omnimapper::plugins)

namespace omnimapper::plugins {

namespace {
constexpr std::uint32_t kSavedPosesVersion = 1;
}

const base::OptionTable<RobotPoseOptions>& RobotPoseOptions::table() {
  using Options = RobotPoseOptions;
  static const auto table =
      base::OptionTable<Options>()
          .text("label", &Options::label, "Sensor label; empty for every such observation.")
          .flag("reference_is_map", &Options::reference_is_map,
                "The poses are in the map's frame; else the place of their frame in the map is estimated.")
          .number("position_sigma_m", &Options::position_sigma, base::Range::positive(),
                  "Standard deviation where an observation tells no covariance.")
          .number("angle_sigma_deg", &Options::angle_sigma, base::Range::positive(),
                  "Standard deviation where an observation tells no covariance.")
          .number("loss_scale", &Options::loss_scale, base::Range::positive(),
                  "Scale of the Cauchy loss, in standard deviations.");
  return table;
}

bool RobotPosePlugin::wants(const mrpt::obs::CObservation& observation) const {
  return dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation) &&
         (options_.label.empty() || observation.sensorLabel == options_.label);
}

mapper::Batch RobotPosePlugin::measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                                       const mapper::View&) {
  const auto& measured = dynamic_cast<const mrpt::obs::CObservationRobotPose&>(observed.observation);
  mapper::Batch batch;
  mapper::Decision decision;
  decision.stamp = frame.stamp;
  decision.plugin = context_.section;
  decision.kind = "absolute pose";
  decision.from = frame.id;

  const auto reference_from_base = geometry::fromMrpt(measured.pose.mean + (-measured.sensorPose));
  geometry::Matrix6d covariance = geometry::Matrix6d::Zero();
  const auto& reported = measured.pose.cov.asEigen();
  if (reported.allFinite() && reported.trace() > 0) {
    const auto body_from_base = geometry::inverse(geometry::fromMrpt(measured.sensorPose));
    covariance = geometry::composeCovariance(geometry::covarianceFromMrpt(measured.pose.mean, reported), body_from_base,
                                             geometry::Matrix6d::Zero());
  } else {
    covariance.diagonal().head<3>().setConstant(options_.position_sigma * options_.position_sigma);
    covariance.diagonal().tail<3>().setConstant(options_.angle_sigma * options_.angle_sigma);
  }
  if (!reference_from_base.translation.allFinite() || !reference_from_base.rotation.coeffs().allFinite()) {
    decision.reason = "not finite";
    batch.log(decision);
    return batch;
  }
  decision.accepted = true;
  decision.reason = "taken";
  const auto pose = geometry::toMrpt(reference_from_base);
  if (!options_.reference_is_map && !map_from_reference_) {
    map_from_reference_ = batch.addVariable(mapper::poseVariable(context_.motion),
                                            mapper::poseValue(context_.motion, frame.map_from_base + (-pose)));
  }
  auto record = options_.reference_is_map
                    ? mapper::posePrior(context_.motion, frame.pose, pose, covariance, context_.section)
                    : mapper::betweenPoses(context_.motion, *map_from_reference_, frame.pose, {pose, covariance},
                                           context_.section);
  record.loss = graph::Loss::cauchy(options_.loss_scale);
  batch.addFactor(std::move(record));
  batch.log(std::move(decision));
  return batch;
}

void RobotPosePlugin::applied(const mapper::AppliedBatch& ids) {
  if (!ids.variables.empty()) map_from_reference_ = ids.variables.front();
}

std::optional<map::MapSection> RobotPosePlugin::save() const {
  if (!map_from_reference_) return std::nullopt;
  std::ostringstream out;
  writeVariableId(out, *map_from_reference_);
  return map::MapSection{{}, kSavedPosesVersion, out.str()};
}

void RobotPosePlugin::restore(const map::MapSection* saved, const mapper::View& view) {
  if (!saved) return;
  expectVersion(*saved, kSavedPosesVersion);
  if (options_.reference_is_map) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "[" + context_.section +
                          "] reference_is_map = true, but the map that is continued was made with "
                          "false: give that, or map its log again");
  }
  std::istringstream in(saved->bytes);
  map_from_reference_ = readVariableId(in, view, saved->name);
}

std::unique_ptr<mapper::MeasurementPlugin> RobotPosePluginFactory::make(const base::ConfigSection& section,
                                                                        const mapper::PluginContext& context) const {
  return std::make_unique<RobotPosePlugin>(section.read<RobotPoseOptions>(mapper::sectionKeysOfEngine()), context);
}

}  // namespace omnimapper::plugins
