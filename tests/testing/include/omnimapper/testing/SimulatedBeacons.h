#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/testing/FloorPlan.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::testing {

class Dice;

/// Beacons with known numbers, and a sensor on a pan-tilt head that measures them in all directions unless a wall is
/// between, as CObservationBearingRange. The beacon with number i is at positions[i].
struct SimulatedBeacons {
  bool on = false;
  double rate = 5, phase = 0.063;                                     ///< [1/s] [s]
  double sigma_range = 0.02, sigma_yaw = 0.005, sigma_pitch = 0.005;  ///< [m] [rad] [rad]
  double max_range = 8;                                               ///< [m]
  mrpt::poses::CPose3D base_from_head{0.1, -0.05, 0.6, 0, 0, 0};      ///< with pan and tilt at zero
  double pan_reach = 0, pan_period = 7;                               ///< [rad] [s] amplitude and period of the pan
  double tilt_reach = 0, tilt_period = 5;                             ///< [rad] [s] amplitude and period of the tilt
  mrpt::poses::CPose3D reported_from_sensor;          ///< part of the sensor's pose that is not reported
  std::vector<Eigen::Vector3d> positions = inRing();  ///< in the map [m]

  /// Fourteen positions along the walls of FloorPlan::ring(), 1.4 m above the floor.
  static std::vector<Eigen::Vector3d> inRing();
  /// base_from_sensor as reported in the observation `seconds` after the start of the log.
  mrpt::poses::CPose3D baseFromReported(double seconds) const;
  mrpt::obs::CObservation::Ptr measurements(const FloorPlan& plan, const mrpt::poses::CPose3D& map_from_base,
                                            base::Stamp stamp, double seconds, Dice& dice) const;
};

}  // namespace omnimapper::testing
