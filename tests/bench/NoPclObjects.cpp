// Replaces ObjectsPcl.cpp and ObjectsLccp.cpp if PCL is not installed.
#include "ObjectPeers.h"

namespace omnimapper::bench {

std::vector<ObjectPeer> pclObjects() {
  return {};
}

std::vector<ObjectPeer> lccpObjects() {
  return {};
}

}  // namespace omnimapper::bench
