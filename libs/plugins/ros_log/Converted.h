#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/geometry/Se3.h>

#include <cstdint>
#include <string>

#include "Value.h"

namespace omnimapper::ros {

/// A message as an observation, which has no stamp, label and sensor pose yet.
struct Converted {
  mrpt::obs::CObservation::Ptr observation;
  std::string frame;                ///< of the message's header
  geometry::Se3 frame_from_sensor;  ///< the sensor pose is base_from_frame * frame_from_sensor
};

/// The header of a message.
struct Header {
  std::string frame;
  std::int64_t time = 0;     ///< of the measurement [ns since 1970]; 0 if it has none
  std::int64_t number = -1;  ///< of the message, as programs of ROS 1 count them; -1 if there is none
};
Header headerOf(const Value& message);
/// The frame that a text names, without the slash that tf of ROS 1 has before it. Throws BadBytes for a name of more
/// than 1000 bytes, as names are kept.
std::string frameIn(const Value& text);

base::Stamp stampOf(std::int64_t nanoseconds);

/// The pose of a message with position and orientation, or translation and rotation. Throws BadBytes if it is none.
geometry::Se3 poseOf(const Value& pose);
/// The same for a message with the field `pose`, which may be one with covariance.
geometry::Se3 innerPoseOf(const Value& message);

/// Each function throws BadBytes if the message has not the fields of its type.

/// LaserScan, and MultiEchoLaserScan with the first echo of each beam. A range above range_max or infinite is one
/// without an echo; one below range_min or not a number is not valid. Beams may run clockwise.
Converted scanOf(const Value& message);
/// Time from the first beam of a scan to the last, as the scan states it [s]; 0 if it does not.
double sweepOf(const Value& message);
Converted imuOf(const Value& message);
Converted gpsOf(const Value& message);
/// Odometry with the pose of the child frame, and its speed.
Converted odometryOf(const Value& message);

}  // namespace omnimapper::ros
