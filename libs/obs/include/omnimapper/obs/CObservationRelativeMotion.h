#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/opengl/Visualizable.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Stamp.h>

#include <Eigen/Core>

namespace omnimapper::obs {

/// How the robot's base moved over a span of time, as wheel odometry, scan matching or visual odometry measured it.
/// `timestamp` (of the base class) is the end of the span; a new object has no stamps. There is no sensor pose: the
/// motion is the base's own.
class CObservationRelativeMotion : public mrpt::obs::CObservation, public mrpt::opengl::Visualizable {
  DEFINE_SERIALIZABLE(CObservationRelativeMotion, omnimapper::obs)

 public:
  CObservationRelativeMotion();

  /// Start of the span.
  base::Stamp begin;
  /// Pose of the base at the end of the span in the base at its start [m, rad]. Translation and rotation matrix are
  /// stored bit by bit.
  mrpt::poses::CPose3D begin_from_end;
  /// Covariance of begin_from_end, for a small change of the pose in the frame of the base at the end of the span: x y
  /// z [m], then rotation vector [rad]. Zero in directions that are known exactly or cannot move, such as z, roll and
  /// pitch of planar motion.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();

  /// Identity.
  void getSensorPose(mrpt::poses::CPose3D& sensor_pose) const override;
  /// Throws Error(internal) for any pose but identity, because a motion of the base has no sensor pose.
  void setSensorPose(const mrpt::poses::CPose3D& sensor_pose) override;
  void getDescriptionAsText(std::ostream& out) const override;

  bool exportTxtSupported() const override { return true; }
  std::string exportTxtHeader() const override;
  std::string exportTxtDataRow() const override;

  /// Draws both ends as corners, an arrow between them, and the 95 % ellipsoid of the translation, in the base at the
  /// start.
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const override;
};

}  // namespace omnimapper::obs
