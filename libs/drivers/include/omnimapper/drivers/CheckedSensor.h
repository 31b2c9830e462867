#pragma once

#include <cstdint>
#include <string>

namespace omnimapper::drivers {

/// What a driver of this library tells of itself beyond mrpt::hwdrivers::CGenericSensor. For the thread that calls
/// doProcess().
class CheckedSensor {
 public:
  virtual ~CheckedSensor() = default;

  /// Messages or lines that were rejected as invalid since the driver was made.
  virtual std::uint64_t leftOut() const = 0;
  /// How many of what kind, such as "2 malformed, 1 of more than 256 bytes".
  virtual std::string leftOutByReason() const = 0;
  /// Whether others connect to it: to open it again when it is silent would only turn them away.
  virtual bool waitsForOthers() const = 0;
};

}  // namespace omnimapper::drivers
