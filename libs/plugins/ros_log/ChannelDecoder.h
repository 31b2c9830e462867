#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "Channel.h"
#include "Value.h"

namespace omnimapper::ros {

/// What a type of messages is used for.
enum class Role { laser, imu, gps, odometry, image, camera_info, cloud, pose, transforms, other };
Role roleOf(const std::string& type);

/// Decodes the messages of all channels by the definitions that the log has, or else by the usual ones.
class ChannelDecoder {
 public:
  explicit ChannelDecoder(const Channels& channels) : channels_(channels) {}

  /// None for a channel of another role or whose messages cannot be decoded, and for a damaged message, which is
  /// counted. The value refers to the bytes of the message and to this decoder.
  std::optional<Value> decode(const Message& message);
  /// Counts a message that was decoded but has not the fields of its type.
  void refuse(std::size_t channel, const std::string& reason);

  /// Sets the counts of damaged messages to zero.
  void forgetBad();

  Role role(std::size_t channel) { return at(channel).role; }
  /// Why no message of the channel can be decoded; empty if they can.
  const std::string& problem(std::size_t channel) { return at(channel).problem; }
  struct Bad {
    std::uint64_t messages = 0;
    std::string last_reason;  ///< a clause whose subject is the message
  };
  const Bad& bad(std::size_t channel) { return at(channel).bad; }

 private:
  struct State {
    Role role = Role::other;
    Encoding encoding = Encoding::ros1;
    std::unique_ptr<Definition> definition;
    std::string problem;
    Bad bad;
  };
  State& at(std::size_t channel);
  State made(const Channel& channel) const;

  const Channels& channels_;
  std::map<std::size_t, State> states_;
};

}  // namespace omnimapper::ros
