#include <omnimapper/live/HostClock.h>

namespace omnimapper::live {

base::Stamp hostNow() {
  return mrpt::Clock::now();
}

}  // namespace omnimapper::live
