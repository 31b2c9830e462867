#include "hokuyo/ScipCheck.h"

#include <algorithm>
#include <utility>

namespace omnimapper::drivers {

namespace {

constexpr std::size_t kLongestMessage = 64 * 1024;
constexpr std::size_t kStampLine = 4, kDataLine = 64;  // characters, without the checksum
constexpr std::string_view kEnd = "\n\n";

bool hasChecksum(std::string_view line, char checksum) {
  unsigned total = 0;
  for (const char byte : line) total += static_cast<unsigned char>(byte);
  return checksum == static_cast<char>(0x30 + (total & 0x3f));
}

/// Whether the last character is the checksum of those before it; in a line of information, of those before the
/// semicolon.
bool isValidLine(std::string_view line) {
  if (line.size() < 2) return false;
  const auto text = line.substr(0, line.size() - 1);
  return hasChecksum(text, line.back()) ||
         (text.back() == ';' && hasChecksum(text.substr(0, text.size() - 1), line.back()));
}

/// Whether the line has characters of six bits, and at most as many as a data line with its checksum.
bool isValidData(std::string_view line) {
  return line.size() <= kDataLine + 1 &&
         std::all_of(line.begin(), line.end(), [](char byte) { return byte >= 0x30 && byte < 0x70; });
}

/// A message has an echo and a status, then lines of information, or the stamp of a scan and its data in lines of 64
/// characters. An older laser answers its first command with a status of one character and no checksum.
bool isValidMessage(std::string_view message) {
  auto end = message.find('\n');
  if (end == std::string_view::npos || end == 0) return false;
  const bool is_scan = message[0] == 'M' || message[0] == 'G';
  message.remove_prefix(end + 1);
  if (message.size() == 1) return true;
  for (int number = 0; !message.empty(); ++number) {
    end = std::min(message.find('\n'), message.size());
    const auto line = message.substr(0, end);
    message.remove_prefix(std::min(end + 1, message.size()));
    if (!isValidLine(line)) return false;
    if (!is_scan || number == 0) continue;
    if (!isValidData(line) || (number == 1 && line.size() != kStampLine + 1)) return false;
    if (number > 1 && !message.empty() && line.size() != kDataLine + 1) return false;
  }
  return true;
}

}  // namespace

void ScipCheck::setCommand(std::string_view command) {
  echo_ = command.substr(0, command.find('\n'));
}

void ScipCheck::add(std::string_view bytes) {
  // The end of a message may be split between the earlier bytes and these.
  auto from = unfinished_.empty() ? 0 : unfinished_.size() - 1;
  unfinished_ += bytes;
  std::size_t begin = 0;
  for (auto end = unfinished_.find(kEnd, from); end != std::string::npos; end = unfinished_.find(kEnd, begin)) {
    judge(std::string_view(unfinished_).substr(begin, end - begin));
    begin = end + kEnd.size();
  }
  unfinished_.erase(0, begin);
  if (unfinished_.size() > kLongestMessage) {
    unfinished_.clear();
    ++damaged_;
  }
}

void ScipCheck::judge(std::string_view message) {
  // A message that was cut off, or other data, may come before it.
  const auto begin = echo_.empty() ? std::string_view::npos : message.rfind(echo_ + "\n");
  if (begin == std::string_view::npos) {
    if (!message.empty() && !isValidMessage(message)) ++damaged_;  // a valid one is the answer to an earlier command
    return;
  }
  if (begin > 0) ++damaged_;
  message.remove_prefix(begin);
  if (!isValidMessage(message)) return void(++damaged_);
  valid_.append(message).append(kEnd);
}

std::string ScipCheck::take() {
  return std::exchange(valid_, {});
}

}  // namespace omnimapper::drivers
