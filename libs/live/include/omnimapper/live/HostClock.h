#pragma once

#include <omnimapper/base/Stamp.h>

namespace omnimapper::live {

/// The time of this machine, UTC. The only place of the libraries where its clock is read: what a sensor hands out
/// without a stamp gets the time of its arrival, and all behind the sensors goes by stamps.
base::Stamp hostNow();

}  // namespace omnimapper::live
