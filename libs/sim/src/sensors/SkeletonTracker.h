#pragma once

#include <omnimapper/interaction/PointingTables.h>
#include <omnimapper/sim/Sensor.h>
#include <omnimapper/sim_world/Skeleton.h>

#include <vector>

namespace omnimapper::sim {

/// Options of SkeletonTracker.
struct SkeletonTrackerOptions {
  interaction::SkeletonSoftware software = interaction::SkeletonSoftware::openni;
  int table_target = 0;  ///< target whose pointing errors are simulated: 1 to 7, or 0 for those of all
  double width = 0.99483767, height = 0.75049158;  ///< field of view [rad]: 57 and 43 deg, as of the Kinect
  double nearest = 0.8, farthest = 4.0;            ///< range of the torso's distance [m]
  double bias_sigma = 0.03;   ///< of a joint's error that is constant for a person, on each axis [m]
  double noise_sigma = 0.01;  ///< of a joint's error that is drawn in each frame, on each axis [m]
  double frame_share = 0.1;   ///< part of the variance of pointing errors that is drawn in each frame, not once an act
  static const base::OptionTable<SkeletonTrackerOptions>& table();
};

/// The software that finds a skeleton in a depth image: mrpt::obs::CObservationSkeleton of the nearest person whose
/// head or torso is in view. The pose in the INI looks along x; the observation's sensorPose is the optical frame at
/// the same place. MRPT documents neither frame nor unit of the joints: here they are in the optical frame, x to the
/// right, y down, z ahead, in metres (MRPT's own driver writes what NiTE reports, millimetres with y up). A joint's
/// confidence is 1, or 0.5 if it is out of view or hidden and therefore guessed, with three times the noise.
///
/// While a person points, head and elbow are moved such that the head-hand and elbow-hand rays miss the target by
/// angles drawn from the thesis's Tables 12 and 13 (PointingError), which contain the errors of people and software
/// together. The hand stays where it is but for its noise. Theta is mirrored for a left arm. The shift grows while the
/// arm is raised and fades while it is lowered.
///
/// Truth: time_s, person, map_from_sensor (optical frame), joints_in_map {name: [x, y, z]}, and from begin to end of an
/// act "pointing": {arm, target, target_in_map, begin_s, end_s}.
class SkeletonTracker : public Sensor {
 public:
  SkeletonTracker(const SkeletonTrackerOptions& options, const SensorOptions& mount, const SensorContext& context);
  Measurement measure(int k) const override;

 private:
  struct View;
  bool isInView(const Eigen::Vector3d& in_optical) const;
  bool isHidden(const View& view, const Eigen::Vector3d& in_map) const;
  int nearestPerson(const View& view) const;
  Skeleton trueSkeleton(int person, double time) const;
  void blur(const View& view, int k, int person, Skeleton& in_map, std::vector<bool>& guessed) const;
  void missTarget(const View& view, int k, int person, Skeleton& in_map) const;
  std::string truthOf(const View& view, int person, const Skeleton& in_map) const;

  SkeletonTrackerOptions options_of_tracker_;
};

}  // namespace omnimapper::sim
