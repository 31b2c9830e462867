#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace omnimapper::drivers {

/// Passes on the messages of a Hokuyo (SCIP 2.0) whose sums and form are right, and nothing else. A message begins with
/// the echo of the command that it answers and ends with two line feeds; each line but the echo ends with a sum, of six
/// bits: it finds every altered byte, and all but one in 64 of those of several in a line. MRPT's driver skips the
/// sums.
class ScipCheck {
 public:
  /// The command that was sent last, with its line feed or without: only its answers are passed on.
  void setCommand(std::string_view command);
  /// Bytes as they come. At most 64 KiB are kept of a message that does not end.
  void add(std::string_view bytes);
  /// Sound messages since the last call, whole, one after the other.
  std::string take();

  /// Messages with a wrong sum, pieces of messages, and whatever else came between sound ones.
  std::uint64_t damaged() const { return damaged_; }

 private:
  void judge(std::string_view message);

  std::string echo_, unfinished_, sound_;
  std::uint64_t damaged_ = 0;
};

}  // namespace omnimapper::drivers
