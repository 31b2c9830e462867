#include <omnimapper/base/Error.h>
#include <omnimapper/base/Memory.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>  // defines __GLIBC__ if it is glibc's
#include <fstream>
#include <string>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace omnimapper::base {

void keepFreedMemory() {
#if defined(__GLIBC__)
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the largest value that is accepted
#endif
}

namespace {

// Number of OpenBLAS's threads: one for each core that this process may use, unless the user sets it.
rlim_t threadsOfOpenBlas() {
  const char* said = std::getenv("OPENBLAS_NUM_THREADS");
  if (const int threads = said ? std::atoi(said) : 0; threads > 0) return static_cast<rlim_t>(threads);
  cpu_set_t cores;
  if (::sched_getaffinity(0, sizeof cores, &cores) != 0) return 1;
  return static_cast<rlim_t>(std::max(1, CPU_COUNT(&cores)));
}

}  // namespace

void requireAddressSpace() {
  constexpr rlim_t kThread = rlim_t{48} << 20,
                   kRest = rlim_t{64} << 20;  // [bytes] for each thread of OpenBLAS, and for everything else
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  const rlim_t needed = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + kThread * threadsOfOpenBlas() + kRest;
  if (limit.rlim_cur >= needed) return;
  throw Error(ExitCode::out_of_memory,
              "the limit of " + std::to_string(limit.rlim_cur >> 20) +
                  " MiB of address space (ulimit -v) is too low: on this machine the program "
                  "needs " +
                  std::to_string(needed >> 20) +
                  " MiB to start; fewer threads of OpenBLAS need less (OPENBLAS_NUM_THREADS=1)");
}

}  // namespace omnimapper::base
