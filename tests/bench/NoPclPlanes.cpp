// Replaces PlanesPcl.cpp if PCL is not installed.
#include "PlanePeers.h"

namespace omnimapper::bench {

std::vector<PlanePeer> pclPlanes() {
  return {};
}

}  // namespace omnimapper::bench
