#include "SingleThreadedBlas.h"

#include <dlfcn.h>

#include <mutex>

namespace omnimapper::graph {

namespace {

/// Which BLAS and whether OpenMP is loaded is known only at run time.
int call(const char* getter) {
  const auto get = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, getter));
  return get ? get() : -1;
}

void call(const char* setter, int number) {
  const auto set = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, setter));
  if (set && number >= 0) set(number);
}

/// The numbers of threads belong to the process: the first object saves them, and the last one restores them, whichever
/// threads they live in.
struct Held {
  std::mutex mutex;
  int count = 0, blas_threads = 0, openmp_levels = 0;
};
Held& held() {
  static Held instance;
  return instance;
}

}  // namespace

// OpenMP is limited by its levels and not by its number of threads, because CHOLMOD sets its own number.
SingleThreadedBlas::SingleThreadedBlas() {
  const std::lock_guard lock(held().mutex);
  if (held().count++ == 0) {
    held().blas_threads = call("openblas_get_num_threads");
    held().openmp_levels = call("omp_get_max_active_levels");
    call("openblas_set_num_threads", 1);
  }
  call("omp_set_max_active_levels", 0);  // some implementations keep it for each thread
}

SingleThreadedBlas::~SingleThreadedBlas() {
  const std::lock_guard lock(held().mutex);
  if (--held().count > 0) return;
  call("openblas_set_num_threads", held().blas_threads);
  call("omp_set_max_active_levels", held().openmp_levels);
}

}  // namespace omnimapper::graph
