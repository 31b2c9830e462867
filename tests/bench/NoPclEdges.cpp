// Stands for EdgesPcl.cpp where PCL is not installed.
#include "EdgePeers.h"

namespace omnimapper::bench {

std::vector<EdgePeer> pclEdges() {
  return {};
}

}  // namespace omnimapper::bench
