#pragma once

#include <omnimapper/base/Stamp.h>

namespace omnimapper::live {

/// The current time by this machine's clock, UTC. The libraries read this clock nowhere else. An observation that comes
/// without a stamp gets the time of its arrival; everything after the sensors uses only stamps.
base::Stamp hostNow();

}  // namespace omnimapper::live
