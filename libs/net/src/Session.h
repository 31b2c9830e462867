#pragma once

#include <omnimapper/net/Network.h>

namespace omnimapper::net {

/// A copy of a network, for one thread at a time.
class Session {
 public:
  virtual ~Session() = default;
  virtual Tensor run(const Tensor& input) = 0;
};

/// A library's message about a network, in one line and printable, because anybody may have made the network.
std::string asOneLine(std::string text);

std::unique_ptr<Session> openWithOpenCv(const std::string& path);
std::unique_ptr<Session> openWithOnnxRuntime(const std::string& path, const std::string& library);

}  // namespace omnimapper::net
