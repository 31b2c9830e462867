#pragma once

#include <omnimapper/net/Network.h>

namespace omnimapper::net {

/// A copy of a network, for one thread at a time.
class Session {
 public:
  virtual ~Session() = default;
  virtual Tensor run(const Tensor& input) = 0;
};

/// What a library says of a network, which may have been made by anybody: in one line, printable.
std::string asOneLine(std::string text);

std::unique_ptr<Session> openWithOpenCv(const std::string& path);
std::unique_ptr<Session> openWithOnnxRuntime(const std::string& path, const std::string& library);

}  // namespace omnimapper::net
