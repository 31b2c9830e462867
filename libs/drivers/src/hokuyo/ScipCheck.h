#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace omnimapper::drivers {

/// Passes on the messages of a Hokuyo (SCIP 2.0) whose checksums and format are right, and nothing else. A message
/// begins with the echo of the command that it answers and ends with two line feeds; each line but the echo ends with a
/// checksum of six bits, which detects every single altered byte, and 63 of 64 alterations of several bytes of a line.
/// MRPT's driver ignores the checksums.
class ScipCheck {
 public:
  /// Sets the command that was sent last, with or without its line feed; only its answers are passed on.
  void setCommand(std::string_view command);
  /// Adds bytes as they arrive. At most 64 KiB are kept of a message that does not end.
  void add(std::string_view bytes);
  /// The valid messages since the last call, whole, one after the other.
  std::string take();

  /// Number of messages with a wrong checksum, pieces of messages, and other data between valid messages.
  std::uint64_t damaged() const { return damaged_; }

 private:
  void judge(std::string_view message);

  std::string echo_, unfinished_, valid_;
  std::uint64_t damaged_ = 0;
};

}  // namespace omnimapper::drivers
