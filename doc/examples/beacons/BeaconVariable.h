#pragma once

#include <omnimapper/graph/Variable.h>

#include <memory>

namespace beacons {

// Step 1: what is optimized. A beacon hangs at a height that is known from its installation, so only two of its three
// coordinates are free: the value has three numbers (ambient size), a change of it two (tangent size). Where the usual
// kinds do (se2, se3, point2, point3 of omnimapper/graph/VariableKinds.h), take one of them and leave this step out.

/// Kind "beacon": x y z in the map [m]; tangent: x y. The height z never changes.
const std::shared_ptr<const omnimapper::graph::Variable>& beaconVariable();

}  // namespace beacons
