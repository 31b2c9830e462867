#pragma once

#include <omnimapper/base/Stamp.h>

namespace omnimapper::live {

/// The time of this machine, UTC. Only here do the libraries read its clock: an observation that a sensor gives no
/// stamp gets the time of its arrival, and everything after the sensors uses stamps.
base::Stamp hostNow();

}  // namespace omnimapper::live
