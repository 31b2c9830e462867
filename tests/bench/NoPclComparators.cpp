// Stands for ComparatorsPcl.cpp where PCL is not installed.
#include "ComparatorPeers.h"

namespace omnimapper::bench {

std::vector<ComparatorPeer> pclComparators() {
  return {};
}

}  // namespace omnimapper::bench
