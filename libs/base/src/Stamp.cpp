#include <omnimapper/base/Error.h>
#include <omnimapper/base/Stamp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace omnimapper::base {

namespace {
constexpr std::int64_t kTicksPerSecond = 10'000'000;
// MRPT counts from 1601 (see its Clock): 116444736 * 10^9 ticks before 1970.
constexpr std::int64_t kUnixEpochTicks = 116'444'736 * std::int64_t{1'000'000'000};

// A damaged file may contain any stamp. Stamps beyond seven thousand years are limited to that, so that differences do
// not overflow.
constexpr std::int64_t kFarthest = INT64_MAX / 4;

std::int64_t ticksOf(Stamp stamp) {
  return std::clamp<std::int64_t>(stamp.time_since_epoch().count(), -kFarthest, kFarthest);
}
std::int64_t ticksSinceUnixEpoch(Stamp stamp) {
  return ticksOf(stamp) - kUnixEpochTicks;
}
Stamp fromTicks(std::int64_t ticks) {
  return Stamp(Duration(ticks + kUnixEpochTicks));
}
}  // namespace

bool isValid(Stamp stamp) {
  // Limited stamps are not valid, because their differences mean nothing.
  return stamp != Stamp() && ticksSinceUnixEpoch(stamp) > 0 && ticksOf(stamp) < kFarthest;
}

Stamp stampFromUnix(double seconds) {
  // Whole seconds and the fraction are converted separately, so that the product stays exact.
  const double whole = std::floor(seconds);
  return fromTicks(static_cast<std::int64_t>(whole) * kTicksPerSecond +
                   std::llround((seconds - whole) * static_cast<double>(kTicksPerSecond)));
}

double unixSeconds(Stamp stamp) {
  const std::int64_t ticks = ticksSinceUnixEpoch(stamp);
  return static_cast<double>(ticks / kTicksPerSecond) +
         static_cast<double>(ticks % kTicksPerSecond) / static_cast<double>(kTicksPerSecond);
}

std::string formatUnix(Stamp stamp, int decimals) {
  std::int64_t unit = 1;  // ticks in the last printed decimal
  for (int i = decimals; i < 7; ++i) unit *= 10;
  const std::int64_t ticks = ticksSinceUnixEpoch(stamp);
  const bool negative = ticks < 0;
  const std::int64_t units = ((negative ? -ticks : ticks) + unit / 2) / unit;
  const std::int64_t units_per_second = kTicksPerSecond / unit;
  char text[40];
  if (decimals <= 0) {
    std::snprintf(text, sizeof text, "%s%lld", negative ? "-" : "", static_cast<long long>(units));
  } else {
    std::snprintf(text, sizeof text, "%s%lld.%0*lld", negative ? "-" : "",
                  static_cast<long long>(units / units_per_second), decimals < 7 ? decimals : 7,
                  static_cast<long long>(units % units_per_second));
  }
  return text;
}

Stamp parseUnix(const std::string& text) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::unreadable_input, "'" + text + "' is not a time in seconds, such as 1137834225.973760" + why);
  };
  const std::size_t begin = text.rfind('-', 0) == 0 ? 1 : 0;
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string whole = text.substr(begin, point - begin);
  const std::string fraction = point < text.size() ? text.substr(point + 1) : "";
  if (whole.empty() && fraction.empty()) refuse("");
  if ((whole + fraction).find_first_not_of("0123456789") != std::string::npos) refuse("");
  if (whole.size() > 11) refuse(": it lies beyond the year 5000");

  std::int64_t ticks = 0;
  for (const char digit : whole) ticks = ticks * 10 + (digit - '0');
  for (std::size_t i = 0; i < 7; ++i) ticks = ticks * 10 + (i < fraction.size() ? fraction[i] - '0' : 0);
  if (fraction.size() > 7 && fraction[7] >= '5') ++ticks;  // rounded to the tick
  return fromTicks(begin == 1 ? -ticks : ticks);
}

Duration durationFromSeconds(double seconds) {
  return Duration(std::llround(seconds * static_cast<double>(kTicksPerSecond)));
}

double toSeconds(Duration duration) {
  return static_cast<double>(duration.count()) / static_cast<double>(kTicksPerSecond);
}

double secondsBetween(Stamp from, Stamp to) {
  return toSeconds(Duration(ticksOf(to) - ticksOf(from)));
}

}  // namespace omnimapper::base
