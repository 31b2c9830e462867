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
  std::size_t count = 0;     ///< observations, including those without a stamp
  std::size_t no_stamp = 0;  ///< zero, or before 1970
  std::size_t repeated = 0;  ///< with the stamp of the one before
  std::size_t backward = 0;  ///< earlier than the one before, but not by so much that the clock was set
  std::size_t gaps = 0;      ///< pauses of a second or more, five times the usual period
  std::size_t rests = 0;     ///< gaps in which the robot moved by less than 1.5 m according to odometry
  std::size_t jumps = 0;     ///< of the clock: all sensors a minute or more ahead, or ten seconds or more back
  double largest_jump = 0;   ///< [s] signed
  double period = 0;         ///< [s] median of the forward steps; 0: not known
  double longest_gap = 0;    ///< [s] without jumps
  double longest_drive = 0;  ///< [s] longest gap in which the robot may have moved
  double lateness = 0;       ///< [s] largest delay behind the newest stamp of all sensors
  base::Stamp first, last;   ///< earliest and latest, without single stamps a minute or more from the rest
};

/// The 2D scans of one label.
struct ScanFacts {
  std::size_t scans = 0;
  std::size_t empty = 0;        ///< scans without beams
  std::size_t blind = 0;        ///< scans with beams, but without a valid one
  std::size_t all_zero = 0;     ///< blind scans with all ranges 0
  std::size_t all_maximum = 0;  ///< blind scans with all ranges at the sensor's limit, whether marked as valid or not
  std::size_t repeated = 0;     ///< scans with exactly the ranges of the one before
  std::size_t beams = 0;        ///< number of beams of the first scan that has any
  std::size_t other_beams = 0;  ///< scans with another number of beams
  double aperture = 0;          ///< [rad]
  double max_range = 0;         ///< [m] as the scans declare it
  double valid_share = 0;       ///< share of all beams, [0, 1]
  double median_range = 0;      ///< [m] median of the valid beams
  double longest = 0;           ///< [m] largest range of a beam that counts as valid
  double longest_share = 0;     ///< share of the valid beams with exactly that range
  bool sensor_pose_moves = false;
  mrpt::poses::CPose3D base_from_sensor;  ///< of the first scan, unless the INI sets another

  bool isAtOrigin() const;
  bool isUpsideDown() const;
  /// Angle between the scanned plane and the floor, [0, pi / 2] rad.
  double tilt() const;
};

/// The wheel odometry of one label, as poses or motions.
struct OdometryFacts {
  std::size_t readings = 0;
  std::size_t not_finite = 0;
  std::size_t jumps = 0;    ///< implausible steps: longer than 0.5 m plus 5 m/s
  double largest_jump = 0;  ///< [m]
  base::Stamp largest_at;
  double travel = 0, turn = 0;  ///< [m] [rad] sums without the jumps
};

/// Comparison of two odometries over spans of a second or more in which one of them moves.
struct OdometryPair {
  std::string a, b;  ///< labels
  std::size_t spans = 0;
  std::size_t contrary = 0;  ///< spans in which they differ by much more than wheels slip
  base::Stamp first_contrary;
};

/// Absolute poses of one label.
struct PoseFacts {
  std::size_t poses = 0;
  double tilt = 0;  ///< [rad] between the z axis of their frame and the mean z axis of the base, [0, pi]
};

/// Measured direction of up in the frame of given poses, or in the base of a robot on wheels.
struct LevelFacts {
  std::string by;         ///< what measured it: "the accelerometer 'imu'"
  bool of_poses = false;  ///< whether it is in the frame of `poses`, else in the base
  std::string poses;      ///< label of the poses
  bool is_known = false;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit
  double sigma = 0;                               ///< [rad] largest standard deviation of its direction
  std::string reason;                             ///< half a sentence on how it was measured, or why it could not be
  double tilt() const;                            ///< [rad] between `up` and z
};

/// Comparison of odometry with the motion that scan matching finds between pairs of scans, in the base's plane.
struct MotionFacts {
  std::string laser, odometry;  ///< labels; without odometry only the scans are judged
  std::size_t tried = 0;        ///< pairs of scans
  std::size_t matched = 0;      ///< of these, pairs that scan matching succeeds for
  std::size_t moved = 0;        ///< matched pairs with motion according to the scans
  std::size_t frozen = 0;       ///< of these, pairs at rest according to the odometry
  std::size_t forward = 0;      ///< pairs with motion along x according to both
  std::size_t forward_reversed = 0;
  std::size_t turning = 0;  ///< pairs with a turn according to both
  std::size_t turning_reversed = 0;
  double speed = 0;  ///< [m/s] according to the scans, exceeded by one in ten pairs
  base::Stamp first_frozen;

  std::optional<double> turn_scale;  ///< turn by odometry divided by turn by scans; none if too few pairs turn
  double wall_distance = 0;  ///< [m] of the points of one scan from the walls of the other, median of the matches
  /// [rad] Aperture, from the first beam to the last, with which the scans match better and turn as the odometry does.
  /// None if the declared one is right. If set, the declared one is wrong, and all other members hold for this one.
  std::optional<double> aperture;

  /// Correction of the sensor pose with which scans and odometry agree: pose, in the true base, of the base that the
  /// reported sensor pose implies.
  struct Mounting {
    double x = 0, y = 0, yaw = 0;  ///< [m] [rad] base_from_base_as_reported
    double position_sigma = 0, yaw_sigma = 0;
    double scale = 1;  ///< distance by odometry divided by distance by scans
  };
  std::optional<Mounting> mounting;  ///< none if the pairs do not determine it

  /// Standard deviations after 1 m travelled or 1 rad of turning, as in [odometry]; none if there are too few pairs.
  std::optional<double> position_noise_per_root_m;  ///< [m]
  std::optional<double> yaw_noise_per_root_turn;    ///< [rad]
  std::optional<double> yaw_noise_per_root_m;       ///< [rad]
};

/// Statistics on the content of a log.
struct LogFacts {
  /// Observations that the source left out, by (label, reason as source::ObservationGate gives it). The other members
  /// are of the observations that were used.
  std::map<std::pair<std::string, std::string>, source::LeftOut> unusable;
  std::size_t missing_images = 0;   ///< observations left out because an external file cannot be read
  std::string first_missing_image;  ///< the first such file
  std::map<std::pair<std::string, std::string>, StampFacts> sensors;  ///< by (label, class)
  std::map<std::string, ScanFacts> scans;                             ///< by label
  std::map<std::string, OdometryFacts> odometry;                      ///< by label
  std::vector<OdometryPair> odometry_pairs;                           ///< every two of them
  std::map<std::string, PoseFacts> poses;                             ///< CObservationRobotPose by label
  std::vector<LevelFacts> levels;                                     ///< of all poses, and of the base
  std::vector<MotionFacts> motions;                                   ///< of each laser with each odometry
  /// Share of a laser's scans within the time span of an odometry, by (laser, odometry).
  std::map<std::pair<std::string, std::string>, double> covered;
};

}  // namespace omnimapper::check
