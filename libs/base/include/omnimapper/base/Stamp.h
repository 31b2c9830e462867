#pragma once

#include <mrpt/core/Clock.h>

#include <cstdint>
#include <string>

namespace omnimapper::base {

/// A point in time in MRPT's ticks: 100 ns since the year 1601, UTC. A default-constructed Stamp is "no stamp".
using Stamp = mrpt::Clock::time_point;
/// A time span in ticks of 100 ns.
using Duration = mrpt::Clock::duration;

/// False for MRPT's "no stamp" and for any time before 1970, which no sensor of a rawlog can mean.
bool isValid(Stamp stamp);

/// The stamp of a Unix time [s], as logs and TUM files have it, rounded to the tick.
Stamp stampFromUnix(double seconds);
/// Unix time [s]. A double holds a present-day stamp only to about 0.2 us: use formatUnix() for files.
double unixSeconds(Stamp stamp);
/// Unix time [s] in decimal; 7 decimals are exact to the tick, fewer are rounded.
std::string formatUnix(Stamp stamp, int decimals = 7);
/// Reads a text of formatUnix(), exactly to the tick (a double would round it). Throws Error(unreadable_input) for any
/// other text.
Stamp parseUnix(const std::string& text);

/// A time span [s], rounded to the tick.
Duration durationFromSeconds(double seconds);
double toSeconds(Duration duration);
/// to - from [s]. Stamps that are off by thousands of years, as in damaged files, are limited to seven thousand years.
double secondsBetween(Stamp from, Stamp to);

}  // namespace omnimapper::base
