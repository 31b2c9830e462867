#pragma once

#include <mrpt/img/TCamera.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ChannelDecoder.h"
#include "Images.h"
#include "MessageReader.h"
#include "Transforms.h"

namespace omnimapper::ros {

/// A sensor, or whatever else has a clock: the topic, and the frame of its headers; of transforms the child frame. Two
/// sensors may share a topic.
using SensorKey = std::pair<std::string, std::string>;

/// What a survey saw of a sensor.
struct SeenSensor {
  Role role = Role::other;
  std::uint64_t messages = 0;
  std::string header_frame;  ///< of odometry: the frame in which its poses are; the key has the child frame
  std::vector<std::int64_t>
      delays;  ///< time of recording minus that of the header [ns], of the first headers with a time
  std::uint64_t without_time = 0;                ///< headers whose time is 0
  double sweep = 0;                              ///< [s] of the last scan, as Converted's sweepOf()
  ImageContent content = ImageContent::picture;  ///< of images
  std::string unused_fields;                     ///< of the points of clouds, with commas: all but x, y and z
};

/// The camera that a CameraInfo states.
struct CalibratedCamera {
  std::string frame;
  mrpt::img::TCamera raw, rectified;
  std::string problem;  ///< a clause whose subject is the CameraInfo; empty if all is well
};

/// What a log contains, from its beginning: all of it, or the first 256 MiB of messages.
struct Survey {
  std::map<SensorKey, SeenSensor> sensors;
  std::map<std::string, CalibratedCamera> cameras;  ///< by the topic of the CameraInfo
  Transforms transforms;                            ///< with the last transforms
  bool is_complete = false;

  /// Reads from the reader's first message, and rewinds it.
  static Survey of(MessageReader& reader, const Channels& channels, ChannelDecoder& decoder);
};

/// One transform of a message of tf.
struct StampedTransform {
  std::string parent, child;
  std::int64_t time = 0;
  geometry::Se3 parent_from_child;
};
/// Throws BadBytes. Transforms without a valid rotation are left out.
std::vector<StampedTransform> transformsOf(const Value& message);

/// Whether this is the topic of transforms that hold for all times.
bool isStaticTopic(const std::string& topic);

}  // namespace omnimapper::ros
