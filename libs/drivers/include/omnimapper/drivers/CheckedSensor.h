#pragma once

#include <cstdint>
#include <string>

namespace omnimapper::drivers {

/// What a driver of this library reports in addition to mrpt::hwdrivers::CGenericSensor. The functions are to be called
/// from the thread that calls doProcess().
class CheckedSensor {
 public:
  virtual ~CheckedSensor() = default;

  /// Number of messages or lines that were rejected as invalid since the driver was made.
  virtual std::uint64_t leftOut() const = 0;
  /// Counts of the rejected messages or lines by kind, such as "2 malformed, 1 of more than 256 bytes".
  virtual std::string leftOutByReason() const = 0;
  /// Whether this driver waits for clients that connect to it. If so, the driver is not opened again when it is silent,
  /// because that would only disconnect the clients.
  virtual bool waitsForOthers() const = 0;
  /// Whether this driver sends only what somebody asks for. If so, its silence is not reported.
  virtual bool sendsOnRequest() const { return false; }
};

}  // namespace omnimapper::drivers
