#include "Fault.h"

#include <omnimapper/base/Error.h>

#include <map>
#include <random>
#include <regex>

namespace omnimapper::players {

Fault parseFault(const std::string& text) {
  using Kind = Fault::Kind;
  static const std::map<std::string, Kind> kinds{{"garbage", Kind::garbage},   {"half", Kind::half},
                                                 {"checksum", Kind::checksum}, {"slow", Kind::slow},
                                                 {"silence", Kind::silence},   {"hangup", Kind::hangup}};
  static const std::regex form(R"((\w+)@(\d{1,9})(?::(\d{1,6}(?:\.\d{1,6})?))?)");
  std::smatch match;
  if (!std::regex_match(text, match, form) || kinds.count(match[1]) == 0)
    throw base::Error(base::ExitCode::command_line,
                      "\"" + text +
                          "\" is no fault: write KIND@NUMBER or KIND@NUMBER:SECONDS, such as silence@50:2.5, with "
                          "garbage, half, checksum, slow, silence or hangup, and the number of the scan or of the line "
                          "of odometry, from 0");
  Fault fault{kinds.at(match[1]), std::stoul(match[2]), match[3].matched ? std::stod(match[3]) : 0};
  if (fault.kind >= Kind::slow && !match[3].matched) fault.seconds = 1;
  return fault;
}

Fault parseOdometryFault(const std::string& text) {
  const Fault fault = parseFault(text);
  if (fault.kind == Fault::Kind::checksum || fault.kind == Fault::Kind::slow)
    throw base::Error(base::ExitCode::command_line,
                      "\"" + text +
                          "\" is only for lasers: a line of odometry has no checksum and is sent at once; write "
                          "garbage, half, silence or hangup");
  return fault;
}

std::string damaged(const std::string& message, Fault::Kind kind, std::uint64_t seed) {
  if (kind == Fault::Kind::half) return message.substr(0, message.size() / 2);
  if (kind == Fault::Kind::garbage) {
    std::mt19937_64 random(seed);
    std::string garbage(300, '\0');
    for (char& byte : garbage) byte = static_cast<char>(random());
    return garbage + message;
  }
  // Echo, status and stamp are one line each; then follows the first range, highest bits first.
  std::string altered = message;
  std::size_t line = 0;
  for (int i = 0; i < 3 && line != std::string::npos; ++i) {
    line = message.find('\n', line);
    if (line != std::string::npos) ++line;
  }
  if (line < altered.size()) altered[line] = static_cast<char>(0x30 + ((altered[line] - 0x30) ^ 1));
  return altered;
}

}  // namespace omnimapper::players
