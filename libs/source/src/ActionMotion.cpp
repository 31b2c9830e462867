#include "ActionMotion.h"

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Covariance.h>

#include <cmath>

namespace omnimapper::source {

using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CActionRobotMovement3D;
using mrpt::poses::CPose2D;

namespace {

// Motion model of Thrun, Burgard, Fox: Probabilistic Robotics (2005), 5.4: rotation, translation, rotation, each with
// its own deviation.
// Covariance of x y yaw in the axes of the start, to first order.
Eigen::Matrix3d thrunCovariance(const CPose2D& increment,
                                const CActionRobotMovement2D::TMotionModelOptions::TOptions_ThrunModel& model) {
  const double travel = increment.norm();
  const double first_turn = travel > 0 ? std::atan2(increment.y(), increment.x()) : 0.0;
  const double second_turn = geometry::wrapToPi(increment.phi() - first_turn);
  const Eigen::Vector3d deviations(
      model.alfa1_rot_rot * std::abs(first_turn) + model.alfa2_rot_trans * travel,
      model.alfa3_trans_trans * travel + model.alfa4_trans_rot * (std::abs(first_turn) + std::abs(second_turn)),
      model.alfa1_rot_rot * std::abs(second_turn) + model.alfa2_rot_trans * travel);
  Eigen::Matrix3d jacobian;                             // of x y yaw by first turn, translation, second turn
  jacobian << -increment.y(), std::cos(first_turn), 0,  //
      increment.x(), std::sin(first_turn), 0,           //
      1, 0, 1;
  const Eigen::Matrix3d scaled = jacobian * deviations.asDiagonal();
  const double xy = model.additional_std_XY, yaw = model.additional_std_phi;
  return scaled * scaled.transpose() + Eigen::Vector3d(xy * xy, xy * xy, yaw * yaw).asDiagonal().toDenseMatrix();
}

ActionMotion planarMotion(const CActionRobotMovement2D& action) {
  CPose2D mean;
  Eigen::Matrix3d covariance;
  const auto& model = action.motionModelConfiguration;
  const bool is_odometry = action.estimationMethod == CActionRobotMovement2D::emOdometry;
  if (is_odometry && model.modelSelection == CActionRobotMovement2D::mmThrun) {
    mean = action.rawOdometryIncrementReading;
    covariance = thrunCovariance(mean, model.thrunModel);
  } else {
    mrpt::poses::CPosePDFGaussian gaussian;
    gaussian.copyFrom(*action.poseChange);
    mean = gaussian.mean;
    covariance = gaussian.cov.asEigen();
  }
  return {is_odometry ? "" : "scan_matching", geometry::lift(geometry::fromMrpt(mean)),
          geometry::embedPlanar(geometry::covarianceFromMrpt(mean, covariance)), 1};
}

ActionMotion spatialMotion(const CActionRobotMovement3D& action) {
  const auto gaussian = geometry::fromMrpt(action.poseChange);
  return {action.estimationMethod == CActionRobotMovement3D::emOdometry ? "" : "visual", gaussian.mean, gaussian.cov,
          1};
}

}  // namespace

std::optional<ActionMotion> motionOf(const mrpt::obs::CAction::ConstPtr& action) {
  if (const auto* planar = dynamic_cast<const CActionRobotMovement2D*>(action.get())) {
    if (planar->poseChange) return planarMotion(*planar);
  } else if (const auto* spatial = dynamic_cast<const CActionRobotMovement3D*>(action.get())) {
    return spatialMotion(*spatial);
  }
  return std::nullopt;
}

ActionMotion join(const ActionMotion& a, const ActionMotion& b) {
  return {b.origin, a.begin_from_end * b.begin_from_end,
          geometry::composeCovariance(a.covariance, b.begin_from_end, b.covariance), a.actions + b.actions};
}

}  // namespace omnimapper::source
