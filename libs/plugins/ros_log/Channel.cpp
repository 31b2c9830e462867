#include "Channel.h"

namespace omnimapper::ros {

std::size_t Channels::index(const Channel& channel) {
  const auto [found, is_new] = indices_.emplace(channel, channels_.size());
  if (is_new) channels_.push_back(channel);
  return found->second;
}

Message detached(const Message& message) {
  auto buffer = std::make_shared<const std::string>(message.bytes);
  return {message.channel, message.time, buffer, *buffer};
}

std::string plainType(const std::string& type) {
  const std::string middle = "/msg/";
  const auto at = type.find(middle);
  return at == std::string::npos ? type : type.substr(0, at + 1) + type.substr(at + middle.size());
}

}  // namespace omnimapper::ros
