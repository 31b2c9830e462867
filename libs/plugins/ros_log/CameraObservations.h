#pragma once

#include <deque>
#include <map>

#include "CameraPlan.h"
#include "ChannelDecoder.h"
#include "Converted.h"
#include "Plan.h"

namespace omnimapper::ros {

/// Makes observations of images when they are due: depths with the picture that is nearest in time.
class CameraObservations {
 public:
  CameraObservations(const CameraPlan& plan, ChannelDecoder& decoder) : plan_(plan), decoder_(decoder) {}

  /// Keeps a picture for depths that come later or are due later.
  void keep(const std::string& topic, std::int64_t time, const Message& message);

  /// The observation of an image whose message was kept until it is due. Throws BadBytes if it cannot be read. For
  /// `transforms` at `time`, a picture of another frame is placed on the depth camera.
  Converted make(const std::string& topic, std::int64_t time, const Message& message, const Transforms& transforms);

  std::uint64_t withoutPicture() const { return without_picture_; }

 private:
  Converted depths(const CameraUse& use, std::int64_t time, const Value& message, const Transforms& transforms);
  const Message* nearestPicture(const std::string& topic, std::int64_t time) const;

  const CameraPlan& plan_;
  ChannelDecoder& decoder_;
  std::map<std::string, std::deque<std::pair<std::int64_t, Message>>> pictures_;  // newest last
  std::uint64_t without_picture_ = 0;
};

/// A cloud of PointCloud2: the points with finite x, y and z [m] in the frame of the message. Throws BadBytes.
Converted cloudOf(const Value& message);

}  // namespace omnimapper::ros
