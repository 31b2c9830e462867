#include "Lanes.h"

namespace omnimapper::perception::planes {

bool hasAvx2() {
#if defined(__x86_64__)
  static const bool has = __builtin_cpu_supports("avx2");
  return has;
#else
  return false;
#endif
}

}  // namespace omnimapper::perception::planes
