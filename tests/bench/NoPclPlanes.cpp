// Stands for PlanesPcl.cpp where PCL is not installed.
#include "PlanePeers.h"

namespace omnimapper::bench {

std::vector<PlanePeer> pclPlanes() {
  return {};
}

}  // namespace omnimapper::bench
