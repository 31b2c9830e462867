#include "Channel.h"

#include <algorithm>

namespace omnimapper::ros {

std::size_t Channels::index(const Channel& channel) {
  const auto found = std::find(channels_.begin(), channels_.end(), channel);
  if (found == channels_.end()) {
    channels_.push_back(channel);
    return channels_.size() - 1;
  }
  return static_cast<std::size_t>(found - channels_.begin());
}

std::string plainType(const std::string& type) {
  const std::string middle = "/msg/";
  const auto at = type.find(middle);
  return at == std::string::npos ? type : type.substr(0, at + 1) + type.substr(at + middle.size());
}

}  // namespace omnimapper::ros
