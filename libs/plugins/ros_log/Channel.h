#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace omnimapper::ros {

/// Times are from 1970 to 2096 [ns since 1970], so that differences of them do not overflow.
inline constexpr std::int64_t kLatestTime = 4'000'000'000'000'000'000;
constexpr std::int64_t boundedTime(std::int64_t nanoseconds) {
  return nanoseconds < 0 ? 0 : nanoseconds > kLatestTime ? kLatestTime : nanoseconds;
}

/// A topic as one publisher wrote it. A topic has several channels if its publishers wrote different types.
struct Channel {
  std::string topic;
  std::string type;        ///< "sensor_msgs/LaserScan"; the "/msg/" of ROS 2 is left out
  std::string definition;  ///< the text of the type's definition; empty if the log has none
  std::string encoding;    ///< of the messages: "ros1" or "cdr"; any other cannot be decoded
  bool operator<(const Channel& other) const {
    return std::tie(topic, type, definition, encoding) <
           std::tie(other.topic, other.type, other.definition, other.encoding);
  }
};

/// The channels of all files of a log.
class Channels {
 public:
  /// The index of the channel, which is added if it is new.
  std::size_t index(const Channel& channel);
  const Channel& operator[](std::size_t index) const { return channels_[index]; }
  std::size_t size() const { return channels_.size(); }

 private:
  std::vector<Channel> channels_;
  std::map<Channel, std::size_t> indices_;
};

/// A serialized message.
struct Message {
  std::size_t channel = 0;
  std::int64_t time = 0;                      ///< when it was recorded [ns since 1970]
  std::shared_ptr<const std::string> buffer;  ///< owns the bytes
  std::string_view bytes;
};

/// The message with a buffer for its bytes alone, to be kept: a message that was read holds the buffer of its chunk.
Message detached(const Message& message);

/// A part of a file that is read at once.
struct Chunk {
  std::uint64_t offset = 0;  ///< [bytes] in the file; of a table, its first row
  std::uint64_t size = 0;    ///< [bytes] in the file
  std::int64_t first_time = std::numeric_limits<std::int64_t>::max();  ///< of its messages [ns since 1970]
  std::int64_t last_time = std::numeric_limits<std::int64_t>::min();
  bool isTimed() const { return first_time <= last_time; }
  void include(std::int64_t time) {
    first_time = time < first_time ? time : first_time;
    last_time = time > last_time ? time : last_time;
  }
};

/// The name of a type without what only ROS 2 has in it: "sensor_msgs/LaserScan" of "sensor_msgs/msg/LaserScan".
std::string plainType(const std::string& type);

}  // namespace omnimapper::ros
