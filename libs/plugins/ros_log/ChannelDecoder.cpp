#include "ChannelDecoder.h"

namespace omnimapper::ros {

Role roleOf(const std::string& type) {
  static const std::map<std::string, Role> roles = {{"sensor_msgs/LaserScan", Role::laser},
                                                    {"sensor_msgs/MultiEchoLaserScan", Role::laser},
                                                    {"sensor_msgs/Imu", Role::imu},
                                                    {"sensor_msgs/NavSatFix", Role::gps},
                                                    {"nav_msgs/Odometry", Role::odometry},
                                                    {"sensor_msgs/Image", Role::image},
                                                    {"sensor_msgs/CompressedImage", Role::image},
                                                    {"sensor_msgs/CameraInfo", Role::camera_info},
                                                    {"sensor_msgs/PointCloud2", Role::cloud},
                                                    {"geometry_msgs/PoseStamped", Role::pose},
                                                    {"geometry_msgs/PoseWithCovarianceStamped", Role::pose},
                                                    {"tf/tfMessage", Role::transforms},
                                                    {"tf2_msgs/TFMessage", Role::transforms}};
  const auto found = roles.find(type);
  return found == roles.end() ? Role::other : found->second;
}

ChannelDecoder::State ChannelDecoder::made(const Channel& channel) const {
  State state;
  state.role = roleOf(channel.type);
  if (state.role == Role::other) return state;
  if (channel.encoding != "ros1" && channel.encoding != "cdr") {
    state.problem = "its messages are in the encoding '" + channel.encoding + "', which is not read";
    return state;
  }
  state.encoding = channel.encoding == "cdr" ? Encoding::cdr : Encoding::ros1;
  std::string text = channel.definition;
  if (text.empty() && state.encoding == Encoding::cdr) text = usualDefinition(channel.type);
  if (text.empty()) {
    state.problem = "the log has no definition of its type";
    return state;
  }
  try {
    state.definition = std::make_unique<Definition>(channel.type, text);
  } catch (const BadDefinition& bad) {
    state.problem = std::string("the definition of its type ") + bad.what();
  }
  return state;
}

ChannelDecoder::State& ChannelDecoder::at(std::size_t channel) {
  const auto found = states_.find(channel);
  return found != states_.end() ? found->second : states_.emplace(channel, made(channels_[channel])).first->second;
}

std::optional<Value> ChannelDecoder::decode(const Message& message) {
  const State& state = at(message.channel);
  if (!state.definition) return std::nullopt;
  try {
    return decoded(state.definition->layout(), message.bytes, state.encoding);
  } catch (const BadBytes& bad) {
    refuse(message.channel, bad.what());
    return std::nullopt;
  }
}

void ChannelDecoder::refuse(std::size_t channel, const std::string& reason) {
  Bad& bad = at(channel).bad;
  ++bad.messages;
  bad.last_reason = reason;
}

void ChannelDecoder::forgetBad() {
  for (auto& channel_and_state : states_) channel_and_state.second.bad = {};
}

}  // namespace omnimapper::ros
