#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/testing/FloorPlan.h>
#include <omnimapper/testing/SimulatedBeacons.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace omnimapper::testing {

/// Random numbers from a seed, which are the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  /// Uniformly distributed in [low, high).
  double uniform(double low, double high);
  /// Normally distributed with mean 0.
  double normal(double sigma);

 private:
  std::mt19937_64 engine_;
};

struct SimulatedLaser {
  std::string label = "laser";
  mrpt::poses::CPose3D base_from_sensor{0.2, 0, 0.3, 0, 0, 0};
  int beams = 181;
  double aperture = 3.14159265358979323846;  ///< [rad]
  double max_range = 12;                     ///< [m] a beam without a hit within this range is invalid
  double sigma = 0.01;                       ///< [m]
  double rate = 10;                          ///< [1/s]
  double phase = 0.013;                      ///< [s] from the start of the log to the first scan
  double sweep = 0;                          ///< [s] from the first beam, which has the stamp, to the last
};

/// A GPS antenna, as CObservationGPS with a GGA message. Altitudes are exact.
struct SimulatedGps {
  bool on = false;
  double rate = 1, phase = 0.113;                      ///< [1/s] [s]
  double sigma = 0.02;                                 ///< [m] of east and of north
  int quality = 4;                                     ///< of the fix: 1 plain, 4 RTK fixed, 5 RTK float
  mrpt::poses::CPose3D antenna{0.3, 0.1, 1, 0, 0, 0};  ///< base_from_antenna
  mrpt::poses::CPose3D enu_from_map{40, -25, 0, 0.7, 0, 0};
  double latitude = 36.7, longitude = -4.5, altitude = 50;  ///< [deg] [deg] [m] origin of the enu frame
};

/// Motion capture, as CObservationRobotPose.
struct SimulatedTracker {
  bool on = false;
  double rate = 2, phase = 0.213;             ///< [1/s] [s]
  double sigma = 0.005, angle_sigma = 0.005;  ///< [m] [rad]
  mrpt::poses::CPose3D base_from_body{0.1, -0.05, 0.4, 0.3, 0, 0};
  mrpt::poses::CPose3D reference_from_map{3, 2, 0, 1.1, 0, 0};
};

struct SimulatedLogOptions {
  enum class Place { ring, box };
  Place place = Place::ring;
  double laps = 1;                          ///< number of rounds, which start and end at the origin
  double speed = 0.7;                       ///< [m/s] reached and left within the first and last second
  double odometry_rate = 20;                ///< [1/s]
  double travel_scale = 1.01;               ///< measured over true distance
  double yaw_drift_per_m = 0.003;           ///< [rad/m]
  double position_noise_per_root_m = 0.01;  ///< [m]
  double yaw_noise_per_root_turn = 0.02;    ///< [rad]
  std::vector<SimulatedLaser> lasers{SimulatedLaser{}};
  SimulatedGps gps;
  SimulatedTracker tracker;
  SimulatedBeacons beacons;
  std::uint64_t seed = 1;
};

/// The simulated counterpart of real logs: a robot drives round a floor plan without stopping and records its odometry
/// ("odometry"), lasers, and optionally GPS ("gps"), motion capture ("tracker") and measurements of beacons
/// ("beacons"). The same options give the same bits. The random numbers of each sensor are independent of the other
/// sensors. The frame of the map is the base at the start.
class SimulatedLog {
 public:
  explicit SimulatedLog(const SimulatedLogOptions& options = {});

  enum class Format { observations, actions_and_frames };

  const FloorPlan& plan() const { return plan_; }
  base::Stamp begin() const { return begin_; }
  base::Stamp end() const { return begin_ + base::durationFromSeconds(duration_); }
  /// Length of one lap [m].
  double lapLength() const { return 2 * (straight_x_ + straight_y_) + 4 * corner_; }
  /// True map_from_base; before and after the log that of its start and end.
  mrpt::poses::CPose2D truthAt(base::Stamp stamp) const;
  /// All observations in the order of their stamps. Each call makes new objects.
  std::vector<mrpt::obs::CObservation::Ptr> observations() const;

  /// Writes a rawlog, compressed by gzip. `actions_and_frames`: each observation other than odometry is a sensory
  /// frame, after an action with the odometry since the frame before. Both have stamps.
  void writeRawlog(const std::string& path, Format format = Format::observations) const;
  /// Writes the true poses at the stamps of all observations in TUM format.
  void writeTruthTum(const std::string& path) const;

 private:
  struct Odometry {
    base::Stamp stamp;
    mrpt::poses::CPose2D odom_from_base;
  };
  mrpt::poses::CPose2D poseAfter(double travel) const;
  std::vector<Odometry> odometry() const;
  mrpt::obs::CObservation::Ptr scan(const SimulatedLaser& laser, base::Stamp stamp, Dice& dice) const;
  mrpt::obs::CObservation::Ptr fix(base::Stamp stamp, Dice& dice) const;
  mrpt::obs::CObservation::Ptr trackedPose(base::Stamp stamp, Dice& dice) const;

  SimulatedLogOptions options_;
  FloorPlan plan_;
  base::Stamp begin_ = base::stampFromUnix(1'700'000'000);
  double straight_x_, straight_y_, corner_, duration_;  // [m] [m] [m along the bend] [s]
};

}  // namespace omnimapper::testing
