#pragma once

#include <mrpt/core/Clock.h>

#include <cstdint>
#include <string>

namespace omnimapper::base {

/// A moment, as MRPT keeps it: ticks of 100 ns since the year 1601, UTC. A default-made Stamp is "no stamp".
using Stamp = mrpt::Clock::time_point;
/// A span of time in the same ticks.
using Duration = mrpt::Clock::duration;

/// False for MRPT's "no stamp" and for anything before 1970, which no sensor of a rawlog can mean.
bool isValid(Stamp stamp);

/// Unix time [s], as logs and TUM files print it; rounded to the tick.
Stamp stampFromUnix(double seconds);
/// Unix time [s]. A double holds a present-day stamp to about 0.2 us: use formatUnix() for files.
double unixSeconds(Stamp stamp);
/// Unix time [s] in decimal, exact to the tick: 7 decimals hold it whole, fewer are rounded.
std::string formatUnix(Stamp stamp, int decimals = 7);
/// Reads what formatUnix() writes without going through a double. Throws Error(input) on anything else.
Stamp parseUnix(const std::string& text);

/// Rounded to the tick.
Duration durationFromSeconds(double seconds);
double toSeconds(Duration duration);
/// to - from [s]. Stamps that are off by thousands of years, as in damaged files, count as seven thousand.
double secondsBetween(Stamp from, Stamp to);

}  // namespace omnimapper::base
