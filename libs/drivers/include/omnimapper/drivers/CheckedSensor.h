#pragma once

#include <cstdint>
#include <string>

namespace omnimapper::drivers {

/// What a driver of this library reports in addition to mrpt::hwdrivers::CGenericSensor. To be called from the thread
/// that calls doProcess().
class CheckedSensor {
 public:
  virtual ~CheckedSensor() = default;

  /// Number of messages or lines that were rejected as invalid since the driver was made.
  virtual std::uint64_t leftOut() const = 0;
  /// Their counts by kind, such as "2 malformed, 1 of more than 256 bytes".
  virtual std::string leftOutByReason() const = 0;
  /// Whether clients connect to it. If so, it is not reopened when it is silent, because that would only disconnect
  /// them.
  virtual bool waitsForOthers() const = 0;
};

}  // namespace omnimapper::drivers
