#pragma once

#include <mrpt/obs/CObservation.h>

#include <string>
#include <vector>

namespace omnimapper::testing {

/// Faults of a robot's recording: what the observations declare, or their stamps, is not what the sensors did.
enum class DeclaredFault {
  laser_sense,        ///< the beams of the laser run the other way round than declared
  laser_roll,         ///< the laser is upside down, which its pose does not state
  laser_yaw,          ///< amount [deg]
  range_limit,        ///< readings are clipped at `amount` [m] and marked as valid, the declared maximum stays
  frozen_scans,       ///< `amount` [share] of the scans repeat the ranges of the one before, in spans of 3 s
  maximum_readings,   ///< `amount` [share] of the beams, one by one, are at the maximum and marked as valid
  wheels_left_right,  ///< the odometry takes left for right
  wheels_clock,       ///< the stamps of the odometry are `amount` [s] late
  camera_yaw,         ///< amount [deg]
  camera_roll,        ///< amount [deg]
  depth_scale,        ///< depths in the log are `amount` times the true ones
  focal_length,       ///< the declared focal length is `amount` times the true one
  mirrored_images,    ///< left and right are exchanged in the depth images
  ranges_as_depths,   ///< pixels hold distances from the camera and are declared as depths
  camera_clock,       ///< the stamps of the depth images are `amount` [s] late
  stamps,             ///< 0: no observation has a stamp; 1: all have the same one
};

struct Fault {
  DeclaredFault kind;
  double amount = 0;
  bool is_gross = false;  ///< it spoils maps, or what is seen in them
};

std::string nameOf(DeclaredFault kind);
/// Whether the fault is one of a depth camera.
bool isOfCamera(DeclaredFault kind);
/// All faults of a kind, from barely wrong to grossly wrong.
std::vector<Fault> gradesOf(DeclaredFault kind);
const std::vector<DeclaredFault>& allDeclaredFaults();

/// The log, which must be sorted by stamp, with a fault, sorted by its stamps unless these are the fault. Observations
/// are copied only if they differ.
std::vector<mrpt::obs::CObservation::Ptr> withFault(const std::vector<mrpt::obs::CObservation::Ptr>& log,
                                                    const Fault& fault);

}  // namespace omnimapper::testing
