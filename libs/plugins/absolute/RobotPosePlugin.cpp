#include "RobotPosePlugin.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/graph/ChiSquare.h>
#include <omnimapper/obs/GivenPose.h>
#include <omnimapper/plugin/PoseFactors.h>
#include <omnimapper/plugin/SavedVariable.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace omnimapper::plugins {

namespace {
constexpr std::uint32_t kSavedPosesVersion = 1;

// Length of an error in standard deviations, in the directions that such a map has.
double sigmasOf(const geometry::Vector6d& error, const geometry::Matrix6d& covariance, mapper::Motion motion) {
  if (motion == mapper::Motion::spatial) return std::sqrt(error.dot(covariance.ldlt().solve(error)));
  const Eigen::Vector3d planar(error[0], error[1], error[5]);
  return std::sqrt(planar.dot(geometry::planarPart(covariance).ldlt().solve(planar)));
}

// Length that the largest of so many errors reaches in one of a thousand runs, if the covariances are correct.
double largestOf(std::size_t count, mapper::Motion motion) {
  constexpr double kFalseAlarms = 0.001;
  const int directions = motion == mapper::Motion::spatial ? 6 : 3;
  return std::sqrt(graph::chiSquareQuantile(1 - kFalseAlarms / static_cast<double>(count), directions));
}
}  // namespace

const base::OptionTable<RobotPoseOptions>& RobotPoseOptions::table() {
  using Options = RobotPoseOptions;
  static const auto table =
      base::OptionTable<Options>()
          .text("label", &Options::label, "Sensor label of the pose observations; empty for all of them.")
          .flag("reference_is_map", &Options::reference_is_map,
                "true: the poses are given in the map frame. false: they are given in another frame, whose pose in the "
                "map is estimated.")
          .number("position_sigma_m", &Options::position_sigma, base::Range::positive(),
                  "Standard deviation of each coordinate where an observation reports no covariance.")
          .number("angle_sigma_deg", &Options::angle_sigma, base::Range::positive(),
                  "Standard deviation of each angle where an observation reports no covariance.")
          .number("loss_scale", &Options::loss_scale, base::Range::notNegative(),
                  "Number of standard deviations beyond which a pose that disagrees loses influence (scale of the "
                  "Cauchy loss), so that other measurements can overrule wrong poses. With 0 no pose loses influence.");
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
  mapper::Decision decision(frame, context_.section, "absolute pose");

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
  const auto pose = obs::referenceFromBase(measured);
  if (!pose) {
    decision.reason = "not finite";
    batch.log(decision);
    return batch;
  }
  decision.accepted = true;
  decision.reason = "taken";
  given_.push_back({frame.id, *pose, covariance});
  if (!options_.reference_is_map && !map_from_reference_) {
    map_from_reference_ = batch.addVariable(mapper::poseVariable(context_.motion),
                                            mapper::poseValue(context_.motion, frame.map_from_base + (-*pose)));
  }
  auto record = options_.reference_is_map
                    ? mapper::posePrior(context_.motion, frame.pose, *pose, covariance, context_.section)
                    : mapper::betweenPoses(context_.motion, *map_from_reference_, frame.pose, {*pose, covariance},
                                           context_.section);
  if (options_.loss_scale > 0) record.loss = graph::Loss::cauchy(options_.loss_scale);
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
  mapper::writeVariableId(out, *map_from_reference_);
  return map::MapSection{{}, kSavedPosesVersion, out.str()};
}

void RobotPosePlugin::restore(const map::MapSection* saved, const mapper::View& view) {
  if (!saved) return;
  mapper::expectVersion(*saved, kSavedPosesVersion);
  if (options_.reference_is_map) {
    throw base::Error(base::ExitCode::unreadable_input,
                      "[" + context_.section +
                          "] reference_is_map = true, but the map that is continued was made with "
                          "false: set it to false, or map its log again");
  }
  std::istringstream in(saved->bytes);
  map_from_reference_ = mapper::readVariableId(in, view, saved->name);
}

std::vector<mapper::Evidence> RobotPosePlugin::evidence(const mapper::View& view) const {
  using mapper::Evidence;
  if (given_.empty()) return {};
  mrpt::poses::CPose3D map_from_reference;
  if (map_from_reference_) map_from_reference = mapper::poseOf(view.graph, *map_from_reference_);
  double sigmas = 0, metres = 0, degrees = 0, seconds = 0;
  for (const auto& given : given_) {
    const auto& frame = view.map.keyFrame(given.frame);
    auto expected = geometry::fromMrpt(map_from_reference + given.reference_from_base);
    if (context_.motion == mapper::Motion::planar) expected = geometry::lift(geometry::project(expected));
    const auto off = geometry::minus(geometry::fromMrpt(frame.map_from_base), expected);
    const double now = sigmasOf(off, given.covariance, context_.motion);
    if (!(now >= sigmas)) continue;
    sigmas = now;
    metres = off.head<3>().norm();
    degrees = off.tail<3>().norm() / base::option_text::kRadiansPerDegree;
    seconds = base::secondsBetween(view.map.key_frames.begin()->stamp, frame.stamp);
  }
  char text[160];
  std::snprintf(text, sizeof text, "the map deviates by at most %.3g m and %.2g deg from the given poses", metres,
                degrees);
  Evidence evidence{"from_given_poses_sigmas", sigmas, Evidence::Says::good, text};
  if (sigmas > largestOf(given_.size(), context_.motion)) {
    std::snprintf(text, sizeof text,
                  "%.0f s after the start the map deviates by %.3g m and %.2g deg from the given pose, %.0f of its "
                  "standard deviations",
                  seconds, metres, degrees, sigmas);
    evidence.says = Evidence::Says::against_it;
    evidence.reason = text;
  }
  return {evidence};
}

}  // namespace omnimapper::plugins
