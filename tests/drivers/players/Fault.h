#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::players {

/// A fault between a player and its host that occurs once. A laser sends messages, one for each scan; odometry comes as
/// lines.
struct Fault {
  enum class Kind {
    garbage,   ///< 300 random bytes come before the message
    half,      ///< only the first half of the message is sent
    checksum,  ///< the first range of the message is altered, but its checksum is not. Only for lasers
    slow,      ///< the message comes in 8 pieces over `seconds`. Only for lasers
    silence,   ///< for `seconds` nothing is sent, and the data are lost
    hangup,    ///< the connection ends, and nobody can connect for `seconds`
  };
  Kind kind = Kind::garbage;
  std::size_t at = 0;  ///< number of the scan, or of the line, in the log, from 0
  double seconds = 0;  ///< of slow, silence and hangup
};

/// Reads "KIND@NUMBER" or "KIND@NUMBER:SECONDS", such as "silence@50:2.5". Throws Error(command_line) on anything else.
Fault parseFault(const std::string& text);
/// As parseFault(), for a line of odometry. Throws Error(command_line) also for the kinds that are only for lasers.
Fault parseOdometryFault(const std::string& text);

/// The message after a fault of the kind garbage, half or checksum. The same seed gives the same bytes.
std::string damaged(const std::string& message, Fault::Kind kind, std::uint64_t seed);

}  // namespace omnimapper::players
