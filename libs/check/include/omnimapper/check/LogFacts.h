#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/source/SourceReport.h>

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::check {

/// The stamps of one sensor, in order of arrival.
struct StampFacts {
  std::size_t count = 0;     ///< observations, without a stamp too
  std::size_t no_stamp = 0;  ///< zero, or before 1970
  std::size_t repeated = 0;  ///< the stamp of the one before again
  std::size_t backward = 0;  ///< before the one before, by no more than a clock that is set
  std::size_t gaps = 0;      ///< pauses of a second or more, five times the usual period
  std::size_t rests = 0;     ///< of these, those in which the robot stayed where it was, by odometry within 1.5 m
  std::size_t jumps = 0;     ///< of the clock: of all sensors a minute or more ahead, ten seconds or more back
  double largest_jump = 0;   ///< [s] signed
  double period = 0;         ///< [s] median of the steps forward; 0: not known
  double longest_gap = 0;    ///< [s] jumps left out
  double longest_drive = 0;  ///< [s] the longest gap that is no rest
  double lateness = 0;       ///< [s] largest, behind the newest stamp of all sensors
  base::Stamp first, last;   ///< earliest and latest; single ones a minute and more from the rest left out
};

/// The 2D scans of one label.
struct ScanFacts {
  std::size_t scans = 0;
  std::size_t empty = 0;        ///< without beams
  std::size_t blind = 0;        ///< with beams, but without a valid one
  std::size_t all_zero = 0;     ///< of these, all ranges 0
  std::size_t all_maximum = 0;  ///< of these, all at the sensor's limit or marked as invalid at it
  std::size_t repeated = 0;     ///< the ranges of the one before again, to the last bit
  std::size_t beams = 0;        ///< of most scans: of the first that has any
  std::size_t other_beams = 0;  ///< scans with another number of beams
  double aperture = 0;          ///< [rad]
  double max_range = 0;         ///< [m] that the sensor declares
  double valid_share = 0;       ///< of all beams, [0, 1]
  double median_range = 0;      ///< [m] of valid beams
  double longest = 0;           ///< [m] largest range of a beam that counts as valid
  double longest_share = 0;     ///< of the valid beams, those of exactly that range
  bool sensor_pose_moves = false;
  mrpt::poses::CPose3D base_from_sensor;  ///< of the first, where the INI tells no other

  bool isAtOrigin() const;
  bool isUpsideDown() const;
  /// Between the scanned plane and the floor, [0, pi / 2] rad.
  double tilt() const;
};

/// The wheel odometry of one label, poses or motions.
struct OdometryFacts {
  std::size_t readings = 0;
  std::size_t not_finite = 0;
  std::size_t jumps = 0;    ///< steps that no robot makes: more than 0.5 m and 5 m/s
  double largest_jump = 0;  ///< [m]
  base::Stamp largest_at;
  double travel = 0, turn = 0;  ///< [m] [rad] summed, jumps left out
};

/// Two odometries held against one another, over spans of a second or more in which one of them moves.
struct OdometryPair {
  std::string a, b;  ///< labels
  std::size_t spans = 0;
  std::size_t contrary = 0;  ///< of these, those in which they differ by much more than wheels slip
  base::Stamp first_contrary;
};

/// Absolute poses of one label.
struct PoseFacts {
  std::size_t poses = 0;
  double tilt = 0;  ///< [rad] between the z axis of their frame and that of the base on average, [0, pi]
};

/// Which way is up in the frame of given poses, or in the base of a robot on wheels, as something measured it.
struct LevelFacts {
  std::string by;         ///< "the accelerometer 'imu'"
  bool of_poses = false;  ///< in the frame of `poses`, else in the base
  std::string poses;      ///< label
  bool is_known = false;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit
  double sigma = 0;                               ///< [rad] about the axis that is known least
  std::string reason;                             ///< half a sentence
  double lean() const;                            ///< [rad] between `up` and z
};

/// Odometry held against the motion that scan matching finds between pairs of scans, in the base's plane.
struct MotionFacts {
  std::string laser, odometry;  ///< labels; no odometry: what scans alone tell
  std::size_t tried = 0;        ///< pairs of scans
  std::size_t matched = 0;      ///< of these, that fit
  std::size_t moved = 0;        ///< of these, with motion by the scans
  std::size_t frozen = 0;       ///< of these, at rest by the odometry
  std::size_t forward = 0;      ///< pairs with motion along x by both
  std::size_t forward_reversed = 0;
  std::size_t turning = 0;  ///< pairs that turn by both
  std::size_t turning_reversed = 0;
  double speed = 0;  ///< [m/s] that one in ten pairs exceeds, by the scans
  base::Stamp first_frozen;

  std::optional<double> turn_scale;  ///< turning by odometry over turning by scans; none if too few pairs turn
  double wall_distance = 0;  ///< [m] median of the pairs that fit: how far points of one are from walls of the other
  /// [rad] Of the scans, from the first beam to the last: the one with which they turn as the odometry does and fit
  /// better. If there is one, what they declare is wrong, and all else here holds with this one.
  std::optional<double> aperture;

  /// What would make scans and odometry agree: the sensor's true place on the base, seen from where it is said to be.
  struct Mounting {
    double x = 0, y = 0, yaw = 0;  ///< [m] [rad] base_from_base_as_reported
    double position_sigma = 0, yaw_sigma = 0;
    double scale = 1;  ///< way by odometry over way by scans
  };
  std::optional<Mounting> mounting;  ///< none without pairs that tell

  /// Standard deviations after 1 m of way, 1 rad of turning, as [odometry] has them; none if too few pairs tell.
  std::optional<double> position_noise_per_root_m;  ///< [m]
  std::optional<double> yaw_noise_per_root_turn;    ///< [rad]
  std::optional<double> yaw_noise_per_root_m;       ///< [rad]
};

/// What a log holds.
struct LogFacts {
  /// What the source left out, by (label, reason as source::ObservationGate says it); the rest is of the others.
  std::map<std::pair<std::string, std::string>, source::LeftOut> unusable;
  std::size_t missing_images = 0;   ///< observations left out because an external file cannot be read
  std::string first_missing_image;  ///< the first such file
  std::map<std::pair<std::string, std::string>, StampFacts> sensors;  ///< by (label, class)
  std::map<std::string, ScanFacts> scans;                             ///< by label
  std::map<std::string, OdometryFacts> odometry;                      ///< by label
  std::vector<OdometryPair> odometry_pairs;                           ///< each with each
  std::map<std::string, PoseFacts> poses;                             ///< CObservationRobotPose by label
  std::vector<LevelFacts> levels;                                     ///< of all poses and of the base
  std::vector<MotionFacts> motions;                                   ///< of each laser, with each odometry
  /// Share of a laser's scans that lie in the time of an odometry, by (laser, odometry).
  std::map<std::pair<std::string, std::string>, double> covered;
};

}  // namespace omnimapper::check
