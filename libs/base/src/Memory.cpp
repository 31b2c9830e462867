#include <omnimapper/base/Memory.h>

#include <cstdlib>  // defines __GLIBC__, if it is that
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace omnimapper::base {

void keepFreedMemory() {
#if defined(__GLIBC__)
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the most that it takes
#endif
}

}  // namespace omnimapper::base
