#include <omnimapper/drivers/OdometryLine.h>

#include <charconv>
#include <cmath>
#include <vector>

namespace omnimapper::drivers {

namespace {

constexpr double kLargestPosition = 1e6;               // [m]
constexpr double kLargestAngle = 2e3 * M_PI;           // [rad]
constexpr double kLargestSpeed = 100;                  // [m/s], [rad/s]
constexpr std::int64_t kLatestSecond = 4'102'444'800;  // the year 2100
constexpr std::int64_t kTicksPerSecond = 10'000'000;

OdometryLine faulty(LineFault fault) {
  OdometryLine line;
  line.fault = fault;
  return line;
}

/// The words of the line; at most 8, one more than are valid.
std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  const std::string_view blanks = " \t";
  for (auto begin = line.find_first_not_of(blanks); begin != std::string_view::npos && words.size() <= 7;) {
    const auto end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
  return words;
}

template <class Number>
bool isWhole(std::string_view word, Number& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

/// Reads a decimal Unix time, exact to the tick of 100 ns; a double would round present-day stamps.
std::optional<base::Stamp> stampOf(std::string_view word) {
  const auto point = std::min(word.find('.'), word.size());
  std::int64_t seconds = 0, billionths = 0;
  if (!isWhole(word.substr(0, point), seconds) || seconds < 0 || seconds >= kLatestSecond) return std::nullopt;
  if (point < word.size()) {
    const auto decimals = word.substr(point + 1);
    if (decimals.empty() || decimals.size() > 9 || decimals[0] == '-' || !isWhole(decimals, billionths))
      return std::nullopt;
    for (auto digits = decimals.size(); digits < 9; ++digits) billionths *= 10;
  }
  const base::Stamp stamp =
      base::stampFromUnix(0) + base::Duration(seconds * kTicksPerSecond + (billionths + 50) / 100);
  return base::isValid(stamp) ? std::optional(stamp) : std::nullopt;
}

}  // namespace

OdometryLine parseOdometryLine(std::string_view text) {
  const auto words = wordsOf(text);
  if (words.size() != 4 && words.size() != 7) return faulty(LineFault::malformed);
  OdometryLine line;
  if (words[0] != "-") {
    line.stamp = stampOf(words[0]);
    if (!line.stamp) return faulty(LineFault::malformed);
  }
  double numbers[6]{};  // x y yaw vx vy omega
  for (std::size_t i = 1; i < words.size(); ++i)
    if (!isWhole(words[i], numbers[i - 1])) return faulty(LineFault::malformed);
  for (const double number : numbers)
    if (!std::isfinite(number)) return faulty(LineFault::not_finite);
  const auto& [x, y, yaw, vx, vy, omega] = numbers;
  if (std::max(std::abs(x), std::abs(y)) > kLargestPosition || std::abs(yaw) > kLargestAngle ||
      std::max({std::abs(vx), std::abs(vy), std::abs(omega)}) > kLargestSpeed)
    return faulty(LineFault::too_large);
  line.odometry.odometry = mrpt::poses::CPose2D(x, y, yaw);
  line.odometry.hasVelocities = words.size() == 7;
  if (line.odometry.hasVelocities) line.odometry.velocityLocal = mrpt::math::TTwist2D(vx, vy, omega);
  return line;
}

}  // namespace omnimapper::drivers
