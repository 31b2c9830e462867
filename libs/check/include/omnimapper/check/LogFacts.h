#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/source/SourceReport.h>

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::check {

/// A number and its standard deviation.
struct Measured {
  double value = 0, sigma = 0;
  /// Whether it differs from `expected` by more than `least` and by more than four standard deviations.
  bool differs(double expected, double least) const;
};

/// The stamps of one sensor, in order of arrival.
struct StampFacts {
  std::size_t count = 0;     ///< observations, including those without a stamp
  std::size_t no_stamp = 0;  ///< observations whose stamp is zero or before 1970
  std::size_t repeated = 0;  ///< observations with the stamp of the observation before
  std::size_t backward = 0;  ///< stamps that are earlier than the one before by less than ten seconds
  std::size_t gaps = 0;      ///< pauses of at least a second and of at least five times the usual period
  std::size_t rests = 0;     ///< gaps in which the robot moved at most 1.5 m and turned at most 1 rad, by odometry
  std::size_t jumps =
      0;  ///< steps of the clock by ten seconds or more back, or of all sensors by a minute or more ahead
  double largest_jump = 0;   ///< [s] the jump with the largest absolute value, with its sign
  double period = 0;         ///< [s] median of the forward steps; 0 if not known
  double longest_gap = 0;    ///< [s] longest pause; jumps of the clock are not counted
  double longest_drive = 0;  ///< [s] longest gap in which the robot may have moved
  double lateness = 0;       ///< [s] largest delay behind the newest stamp of all sensors
  base::Stamp first,
      last;  ///< earliest and latest stamp; isolated ones, a minute or more from all others, do not count
};

/// By how much the clocks of two sensors differ.
struct ClockFacts {
  double offset = 0;         ///< [s] stamp of the first sensor minus stamp of the second one, for the same moment
  double sigma = 0;          ///< [s] standard deviation
  double drift = 0;          ///< [1] change of the offset per second; 0 unless it changes beyond doubt
  bool is_reversed = false;  ///< one of the two takes left for right
  /// Whether the offset is too large to be noise, and large enough to matter.
  bool isWrong() const;
};

/// Time that a laser takes from the first beam of a scan to the last one, as turns show it.
struct SweepFacts {
  double sweep = 0;     ///< [s]
  double sigma = 0;     ///< [s] standard deviation
  double declared = 0;  ///< [s]
  /// Twice the logarithm of the likelihood ratio of `sweep` and `declared`.
  double advantage = 0;
  /// Whether the declared sweep is wrong beyond doubt.
  bool isWrong() const;
  /// Whether all beams may be simultaneous.
  bool isInstant() const;
};

/// The 2D scans of one label.
struct ScanFacts {
  std::size_t scans = 0;
  std::size_t empty = 0;        ///< scans without beams
  std::size_t blind = 0;        ///< scans with beams, but without a valid one
  std::size_t all_zero = 0;     ///< blind scans with all ranges 0
  std::size_t all_maximum = 0;  ///< blind scans with all ranges at the sensor's limit, whether marked as valid or not
  std::size_t repeated = 0;     ///< scans with valid beams and exactly the ranges of the scan before
  std::size_t beams = 0;        ///< number of beams of the first scan that has any
  std::size_t other_beams = 0;  ///< scans with beams, but another number of them than `beams`
  std::size_t fewest_beams = 0, most_beams = 0;  ///< of the scans with beams
  std::size_t clockwise = 0;                     ///< scans with beams that run clockwise, seen from the laser's z axis
  double aperture = 0;                           ///< [rad] as the scans declare it
  double max_range = 0;                          ///< [m] as the scans declare it
  double valid_share = 0;                        ///< share of the valid beams in all beams, [0, 1]
  double median_range = 0;                       ///< [m] median range of the valid beams
  double single_share = 0;          ///< share of the beams at the declared maximum, marked as valid, amid shorter ones
  double longest = 0;               ///< [m] largest range of a beam that counts as valid
  double longest_share = 0;         ///< share of the valid beams whose range is exactly `longest`
  bool longest_stands_out = false;  ///< far more beams have exactly this range than have the ranges just below it
  bool sensor_pose_moves = false;
  std::optional<Measured> constant_ahead;  ///< [m] range ahead, if it stays the same while the robot drives on
  std::optional<SweepFacts> sweep;         ///< none if the log does not determine it
  mrpt::poses::CPose3D base_from_sensor;   ///< sensor pose of the first scan, or the one that the INI sets

  bool isAtOrigin() const;
  bool isUpsideDown() const;
  /// Angle between the scanned plane and the floor, [0, pi / 2] rad.
  double tilt() const;
};

/// The wheel odometry of one label, given as poses or as motions.
struct OdometryFacts {
  std::size_t readings = 0;
  std::size_t not_finite = 0;
  std::size_t jumps = 0;    ///< implausible steps: longer than 0.5 m plus 5 m for each second
  double largest_jump = 0;  ///< [m]
  base::Stamp largest_at;
  double travel = 0, turn = 0;  ///< [m] [rad] sums over all steps that are no jumps
};

/// Comparison of two odometries over spans of a second or more in which at least one of the two moves.
struct OdometryPair {
  std::string a, b;  ///< labels
  std::size_t spans = 0;
  std::size_t contrary = 0;  ///< spans in which the two differ by more than slip of the wheels explains
  base::Stamp first_contrary;
};

/// Absolute poses of one label.
struct PoseFacts {
  std::size_t poses = 0;
  double tilt = 0;  ///< [rad] in [0, pi], between the z axes of the poses' frame and of the base (mean of the cosine)
};

/// A measured direction of up, in the frame of given poses or in the base of a robot on wheels.
struct LevelFacts {
  std::string by;          ///< what measured the direction: "the accelerometer 'imu'"
  bool by_planes = false;  ///< the planes of depth images measured it
  bool of_poses = false;   ///< true: `up` is in the frame of `poses`; false: in the base
  std::string poses;       ///< label of the poses
  bool is_known = false;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit vector
  double sigma = 0;                               ///< [rad] largest standard deviation of the direction of `up`
  std::string reason;                             ///< part of a sentence: how `up` was measured, or why it was not
  double tilt() const;                            ///< [rad] angle between `up` and the z axis
};

/// Comparison of odometry with the motion that scan matching finds between pairs of scans, in the base's plane.
struct MotionFacts {
  std::string laser, odometry;  ///< labels; if `odometry` is empty, only the scans are judged
  std::size_t tried = 0;        ///< number of pairs of scans
  std::size_t matched = 0;      ///< pairs for which scan matching succeeds
  std::size_t moved = 0;        ///< matched pairs with motion according to the scans
  std::size_t frozen = 0;       ///< pairs with motion according to the scans, but at rest according to the odometry
  std::size_t forward = 0;      ///< pairs with motion along x according to scans and odometry
  std::size_t forward_reversed = 0;  ///< of these, pairs in which the two directions are opposite
  std::size_t turning = 0;           ///< pairs with a turn according to scans and odometry
  std::size_t turning_reversed = 0;  ///< of these, pairs in which the two directions are opposite
  double speed = 0;                  ///< [m/s] according to the scans; one in ten matched pairs is faster
  base::Stamp first_frozen;

  std::optional<ClockFacts> clock;   ///< of the odometry against the laser; none if it cannot be determined
  std::optional<double> turn_scale;  ///< turn by odometry divided by turn by scans, median; none if too few pairs turn
  /// [m] Distance of the points of one scan from the walls of the other: root mean square of a pair, median of the
  /// pairs.
  double wall_distance = 0;
  /// [rad] Set if the aperture that the scans declare is wrong: the angle between the first and the last beam at which
  /// the scans match better and their rotations agree better with those of the odometry. All other members are then
  /// computed with this aperture. None if the declared aperture is right.
  std::optional<double> aperture;

  /// The correction of the sensor pose with which scans and odometry agree. If the reported sensor pose is wrong, the
  /// base frame that follows from it is displaced; the correction is the pose of this displaced frame in the true base.
  struct Mounting {
    double x = 0, y = 0, yaw = 0;  ///< [m] [rad] base_from_base_as_reported
    double position_sigma = 0, yaw_sigma = 0;
    double scale = 1;  ///< distance by odometry divided by distance by scans
  };
  std::optional<Mounting> mounting;  ///< none if the pairs of scans do not determine the correction

  /// Standard deviations of the odometry after 1 m travelled or 1 rad of turning, as in [odometry]; none if there are
  /// too few pairs.
  std::optional<double> position_noise_per_root_m;  ///< [m]
  std::optional<double> yaw_noise_per_root_turn;    ///< [rad]
  std::optional<double> yaw_noise_per_root_m;       ///< [rad]
};

/// Comparison of a depth camera on a robot with the floor, with the odometry, and with the walls that a laser sees.
struct CameraFacts {
  /// What makes the planes of the images agree with the laser.
  enum class Images { as_declared, mirrored, ranges };
  std::string camera, laser;        ///< labels; `laser` is empty if the log has none that can be used
  std::size_t images = 0;           ///< images that were looked at
  std::size_t planes = 0;           ///< planes in them
  unsigned columns = 0, rows = 0;   ///< of the depth images
  double fx = 0, fy = 0;            ///< [px] declared focal lengths, without their signs
  bool has_negative_focal = false;  ///< one of them is negative; all else is computed with positive ones
  double noise = 1;               ///< [-] with which planes are found in them: a factor on the PlaneExtractor's default
  double median_depth = 0;        ///< [m] of the pixels with a depth, as the log declares it
  mrpt::poses::CPose3D declared;  ///< base_from_sensor
  Images are = Images::as_declared;

  std::size_t floor_images = 0;    ///< images that show one and the same level surface below the camera
  std::optional<Measured> height;  ///< [m] distance of the camera from this surface, by its depths
  double tilt = 0;                 ///< [rad] between this surface and the floor that the declared pose implies
  double tilt_sigma = 0;           ///< [rad] standard deviation of the direction of this surface, about each axis
  std::size_t walls = 0;           ///< upright planes in images for which the laser saw something
  std::size_t matched = 0;         ///< those that lie on walls of the laser, with the values below
  std::optional<Measured> yaw;     ///< [rad] true yaw minus declared yaw
  std::optional<Measured> scale;   ///< [-] true depth divided by depth in the log
  std::optional<Measured> focal;   ///< [-] true focal length divided by the declared one
  std::optional<Measured> clock;   ///< [s] stamp of an image minus stamp of the laser for the same moment
  std::optional<mrpt::poses::CPose3D> pose;  ///< base_from_sensor by floor and walls; none if neither was found
};

/// Images whose size is not that of the images for which their camera was calibrated.
struct ImageSizeFacts {
  std::string label;
  bool is_depth = false;                               ///< depth images; else colour images
  double columns = 0, rows = 0;                        ///< [px] of the images
  double calibrated_columns = 0, calibrated_rows = 0;  ///< [px] of the images of the calibration
  double fx = 0, fy = 0, cx = 0, cy = 0;               ///< [px] the calibration, scaled to the images
  /// Whether both have the same shape, so that one may be the other in another resolution.
  bool isScaled() const;
};

/// Comparison of a gyroscope with the turns that scan matching finds.
struct GyroscopeFacts {
  std::string gyroscope, laser;     ///< labels
  std::optional<ClockFacts> clock;  ///< of the gyroscope against the laser; none if it cannot be determined
};

/// What the INI already states or corrects; all facts are those of the corrected observations.
struct IniFacts {
  double sweep = 0;                                            ///< [s] `[scan_odometry] sweep_s`
  double max_range = std::numeric_limits<double>::infinity();  ///< [m] `[laser_points] max_range_m`
  std::map<std::string, double> clock_offsets;                 ///< [s] added to the stamps, by label
  bool has_calibration = false;                                ///< the members below are of a section [calibration]
  std::string calibrated;                                      ///< label; empty for every depth camera
  double depth_noise = 0;  ///< [m] `[planes] noise_at_1m_m`; 0 if the INI does not give it
  double depth_scale = 1;
  bool mirrored = false, depth_is_range = false;
};

/// Statistics on the content of a log.
struct LogFacts {
  IniFacts ini;
  /// Observations that cannot be used, by (label, reason); source::ObservationGate describes the form of a reason.
  /// Observations that the source left out are not counted in the other members.
  std::map<std::pair<std::string, std::string>, source::LeftOut> unusable;
  std::size_t missing_images = 0;   ///< observations left out because an external file cannot be read
  std::string first_missing_image;  ///< the first such file
  std::map<std::pair<std::string, std::string>, StampFacts> sensors;  ///< by (label, class)
  std::map<std::string, ScanFacts> scans;                             ///< by label
  std::map<std::string, OdometryFacts> odometry;                      ///< by label
  std::vector<OdometryPair> odometry_pairs;                           ///< one for every two odometries
  std::map<std::string, PoseFacts> poses;                             ///< CObservationRobotPose by label
  std::vector<LevelFacts> levels;                                     ///< in the frames of all poses, and in the base
  std::vector<MotionFacts> motions;                                   ///< one for each laser with each odometry
  std::vector<GyroscopeFacts> gyroscopes;                             ///< one for each laser with each gyroscope
  std::vector<ImageSizeFacts> other_sizes;                            ///< of cameras with a wrong size only
  std::vector<CameraFacts> cameras;  ///< depth cameras of a robot with odometry or laser
  /// Share of a laser's scans within the time span of an odometry, by (laser, odometry).
  std::map<std::pair<std::string, std::string>, double> covered;
};

}  // namespace omnimapper::check
