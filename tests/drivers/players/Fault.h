#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::players {

/// What goes wrong between a player and its host, once. A laser sends messages, each of a scan; odometry comes as
/// lines.
struct Fault {
  enum class Kind {
    garbage,   ///< 300 random bytes come before the message
    half,      ///< only the first half of the message comes
    checksum,  ///< the first range of the message is altered on its way; its checksum is not. Lasers alone
    slow,      ///< the message comes in 8 pieces over so many seconds. Lasers alone
    silence,   ///< for so many seconds nothing comes, and is lost
    hangup,    ///< the connection ends; nobody can connect for so many seconds
  };
  Kind kind = Kind::garbage;
  std::size_t at = 0;  ///< number of the scan, or of the line, in the log, from 0
  double seconds = 0;  ///< of slow, silence and hangup
};

/// Reads "KIND@NUMBER" or "KIND@NUMBER:SECONDS", such as "silence@50:2.5". Throws Error(command_line) on anything else.
Fault parseFault(const std::string& text);
/// As parseFault(), of a line of odometry. Throws Error(command_line) for the kinds of lasers alone, too.
Fault parseOdometryFault(const std::string& text);

/// The message as it arrives with a fault of the kinds garbage, half or checksum. The same seed gives the same bytes.
std::string damaged(const std::string& message, Fault::Kind kind, std::uint64_t seed);

}  // namespace omnimapper::players
