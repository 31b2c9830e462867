// Replaces ComparatorsPcl.cpp if PCL is not installed.
#include "ComparatorPeers.h"

namespace omnimapper::bench {

std::vector<ComparatorPeer> pclComparators() {
  return {};
}

}  // namespace omnimapper::bench
