// Replaces CloudPlanesPcl.cpp if PCL is not installed.
#include "CloudPeers.h"

namespace omnimapper::bench {

std::vector<CloudPeer> pclCloudPlanes(double, int) {
  return {};
}

}  // namespace omnimapper::bench
