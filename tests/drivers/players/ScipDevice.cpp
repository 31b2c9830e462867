#include "ScipDevice.h"

#include <algorithm>
#include <charconv>

#include "ScipCodec.h"

namespace omnimapper::players {

namespace {

constexpr std::size_t kLongestCommand = 128;

/// The echo of the command and its status. The message ends here with one more line feed, or continues with data.
std::string head(const std::string& echo, const std::string& status) {
  return echo + "\n" + withScipSum(status);
}

std::string plain(const std::string& echo, const std::string& status) {
  return head(echo, status) + "\n";
}

std::optional<int> number(std::string_view digits) {
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || value < 0) return std::nullopt;
  return value;
}

std::string padded(int value, std::size_t digits) {
  const std::string text = std::to_string(value);
  return std::string(digits - std::min(digits, text.size()), '0') + text;
}

}  // namespace

std::string ScipDevice::receive(std::string_view bytes, std::uint32_t now_ms) {
  std::string answers;
  for (const char byte : bytes) {
    if (byte == '\n' || byte == '\r') {
      if (!unfinished_.empty()) answers += answer(unfinished_, now_ms);
      unfinished_.clear();
    } else if (unfinished_.size() < kLongestCommand) {
      unfinished_ += byte;
    }
  }
  return answers;
}

std::string ScipDevice::answer(const std::string& command, std::uint32_t now_ms) {
  const auto semicolon = std::min(command.find(';'), command.size());
  const std::string bare = command.substr(0, semicolon), text = command.substr(semicolon);
  const std::string name = bare.substr(0, 2);
  if (bare == "SCIP2.0") return plain(command, "0E");  // it uses that protocol already
  if (bare == "VV") return head(command, "00") + versionInformation() + "\n";
  if (bare == "PP") return head(command, "00") + productInformation() + "\n";
  if (bare == "II") return head(command, "00") + stateInformation(now_ms) + "\n";
  if (bare == "BM") {
    const std::string status = laser_is_on_ ? "02" : "00";
    laser_is_on_ = true;
    return plain(command, status);
  }
  if (bare == "QT" || bare == "RS" || bare == "RT") {
    request_.reset();
    laser_is_on_ = false;
    return plain(command, "00");
  }
  if (name == "TM" && bare.size() == 3) return timeMode(command, now_ms);
  if (name == "SS" && bare.size() == 8) return plain(command, number(bare.substr(2)) ? "00" : "01");
  if (name == "CR" && bare.size() == 4) {
    const auto ratio = number(bare.substr(2));
    return plain(command, !ratio ? "01" : *ratio > 10 && *ratio != 99 ? "02" : "00");
  }
  if (name == "HS" && bare.size() == 3) return plain(command, bare[2] == '0' || bare[2] == '1' ? "00" : "01");
  for (const char* known : {"MD", "MS", "ME", "GD", "GS", "GE"})
    if (name == known) return startMeasuring(bare, text);
  return plain(command, "0E");
}

std::string ScipDevice::startMeasuring(const std::string& command, const std::string& text) {
  Request request;
  request.name = command.substr(0, 2);
  request.is_single = command[0] == 'G';
  request.text = text;
  const std::string echo = command + text;
  if (command.size() != (request.is_single ? 12U : 15U)) return plain(echo, "0D");
  const auto first = number(command.substr(2, 4)), last = number(command.substr(6, 4));
  const auto cluster = number(command.substr(10, 2));
  const auto interval = number(request.is_single ? "0" : command.substr(12, 1));
  const auto count = number(request.is_single ? "01" : command.substr(13, 2));
  if (!first) return plain(echo, "01");
  if (!last) return plain(echo, "02");
  if (!cluster) return plain(echo, "03");
  if (*last > model_.last) return plain(echo, "04");
  if (*last < *first || *first < model_.first) return plain(echo, "05");
  if (!interval) return plain(echo, "06");
  if (!count) return plain(echo, "07");
  if (request.is_single && !laser_is_on_) return plain(echo, "10");
  request.first = *first;
  request.last = *last;
  request.cluster = *cluster;
  request.interval = *interval;
  request.remaining = *count;
  request_ = request;
  if (request.is_single) return "";  // the next scan is the answer
  laser_is_on_ = true;
  return plain(echo, "00");
}

std::string ScipDevice::timeMode(const std::string& command, std::uint32_t now_ms) {
  switch (command[2]) {
    case '0':
    case '2':
      return plain(command, "00");
    case '1':
      return head(command, "00") + withScipSum(encodeScip(now_ms, 4)) + "\n";
    default:
      return plain(command, "01");
  }
}

std::string ScipDevice::versionInformation() const {
  return scipInformation("VEND:Player of recorded scans") + scipInformation("PROD:" + model_.name) +
         scipInformation("FIRM:1.0.00") + scipInformation("PROT:SCIP 2.0") + scipInformation("SERI:0");
}

std::string ScipDevice::productInformation() const {
  const auto line = [](const char* key, int value) { return scipInformation(key + std::to_string(value)); };
  return scipInformation("MODL:" + model_.name) + line("DMIN:", model_.min_mm) + line("DMAX:", model_.max_mm) +
         line("ARES:", model_.steps_per_turn) + line("AMIN:", model_.first) + line("AMAX:", model_.last) +
         line("AFRT:", model_.front) + line("SCAN:", model_.rpm);
}

std::string ScipDevice::stateInformation(std::uint32_t now_ms) const {
  return scipInformation("MODL:" + model_.name) + scipInformation(laser_is_on_ ? "LASR:ON" : "LASR:OFF") +
         scipInformation("SCSP:" + std::to_string(model_.rpm)) +
         scipInformation(request_ ? "MESM:Measuring" : "MESM:Idle") + scipInformation("SBPS:Ethernet") +
         scipInformation("TIME:" + encodeScip(now_ms, 4)) + scipInformation("STAT:Sensor works well");
}

std::string ScipDevice::measured(const HokuyoScan& scan, std::uint32_t now_ms) {
  if (!request_) return "";
  if (request_->until_next > 0) {
    --request_->until_next;
    return "";
  }
  request_->until_next = request_->interval;
  std::string echo =
      request_->name + padded(request_->first, 4) + padded(request_->last, 4) + padded(request_->cluster, 2);
  const bool is_single = request_->is_single;
  const bool is_last = request_->remaining == 1;
  if (request_->remaining > 0) --request_->remaining;
  if (!is_single) echo += std::to_string(request_->interval) + padded(request_->remaining, 2);
  const std::string message = head(echo + request_->text, is_single ? "00" : "99") +
                              withScipSum(encodeScip(now_ms, 4)) + scipBlock(data(scan)) + "\n";
  if (is_last) request_.reset();
  if (is_last && !is_single) laser_is_on_ = false;
  return message;
}

std::string ScipDevice::data(const HokuyoScan& scan) const {
  const int characters = request_->name[1] == 'S' ? 2 : 3;
  const std::uint32_t largest = characters == 2 ? 4095 : (1U << 18) - 1;
  const bool has_intensities = request_->name[1] == 'E';
  std::string text;
  const int together = std::max(1, request_->cluster);
  for (int step = request_->first; step <= request_->last; step += together) {
    const int end = std::min(step + together, request_->last + 1);
    std::uint32_t smallest = largest, intensity = 0;
    for (int each = step; each < end; ++each) {
      const auto index = static_cast<std::size_t>(each - model_.first);
      const std::uint32_t range = index < scan.ranges_mm.size() ? scan.ranges_mm[index] : 0;
      if (each > step && range >= smallest) continue;
      smallest = std::min(range, largest);
      intensity = index < scan.intensities.size() ? scan.intensities[index] : 0;
    }
    text += encodeScip(smallest, characters);
    if (has_intensities) text += encodeScip(intensity, 3);
  }
  return text;
}

}  // namespace omnimapper::players
