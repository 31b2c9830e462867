#include <omnimapper/base/Error.h>
#include <omnimapper/base/Memory.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>  // defines __GLIBC__, if it is that
#include <fstream>
#include <string>
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

void requireAddressSpace() {
  constexpr rlim_t kThread = rlim_t{48} << 20,
                   kRest = rlim_t{64} << 20;  // bytes, for a thread of OpenBLAS and beside them
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  const rlim_t needed = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) +
                        kThread * static_cast<rlim_t>(std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN))) + kRest;
  if (limit.rlim_cur >= needed) return;
  throw Error(ExitCode::out_of_memory, "the limit of " + std::to_string(limit.rlim_cur >> 20) +
                                           " MiB of address space (ulimit -v) is too low: on this machine the program "
                                           "needs " +
                                           std::to_string(needed >> 20) + " MiB to start");
}

}  // namespace omnimapper::base
