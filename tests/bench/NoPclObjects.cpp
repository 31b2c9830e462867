// Stands for ObjectsPcl.cpp where PCL is not installed.
#include "ObjectPeers.h"

namespace omnimapper::bench {

std::vector<ObjectPeer> pclObjects() {
  return {};
}

}  // namespace omnimapper::bench
