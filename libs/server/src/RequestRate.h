#pragma once

#include <omnimapper/server/HttpServer.h>

#include <algorithm>
#include <chrono>

namespace omnimapper::server {

/// Lets so many requests through in a second, and for a moment more.
class RequestRate {
 public:
  explicit RequestRate(const HttpLimits& limits) : limits_(limits), left_(limits.requests_at_once) {}
  bool take() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    left_ = std::min(limits_.requests_at_once, left_ + seconds * limits_.requests_per_s);
    if (left_ < 1) return false;
    left_ -= 1;
    return true;
  }

 private:
  const HttpLimits& limits_;
  double left_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace omnimapper::server
