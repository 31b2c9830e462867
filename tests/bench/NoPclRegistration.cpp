// Replaces RegistrationPcl.cpp if PCL is not installed.
#include "RegistrationPeers.h"

namespace omnimapper::bench {

std::vector<RegistrationPeer> pclRegistrations() {
  return {};
}

}  // namespace omnimapper::bench
