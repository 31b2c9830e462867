// Replaces EdgesPcl.cpp if PCL is not installed.
#include "EdgePeers.h"

namespace omnimapper::bench {

std::vector<EdgePeer> pclEdges() {
  return {};
}

std::vector<EdgePeer> pclEdgesOfAllKinds() {
  return {};
}

}  // namespace omnimapper::bench
