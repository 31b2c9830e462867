#include "Lanes.h"

#include <cstdlib>
#include <cstring>

namespace omnimapper::perception::planes {

#if defined(__x86_64__)
namespace {
bool isSwitchedOff() {
  const char* value = std::getenv("OMNIMAPPER_AVX2");
  return value != nullptr && std::strcmp(value, "0") == 0;
}
}  // namespace
#endif

bool hasAvx2() {
#if defined(__x86_64__)
  static const bool has = __builtin_cpu_supports("avx2") && !isSwitchedOff();
  return has;
#else
  return false;
#endif
}

}  // namespace omnimapper::perception::planes
