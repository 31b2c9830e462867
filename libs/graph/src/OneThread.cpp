#include "OneThread.h"

#include <dlfcn.h>

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

}  // namespace

// OpenMP by its levels and not by its number of threads, because CHOLMOD names a number of its own.
OneThread::OneThread()
    : blas_threads_(call("openblas_get_num_threads")), openmp_levels_(call("omp_get_max_active_levels")) {
  call("openblas_set_num_threads", 1);
  call("omp_set_max_active_levels", 0);
}

OneThread::~OneThread() {
  call("openblas_set_num_threads", blas_threads_);
  call("omp_set_max_active_levels", openmp_levels_);
}

}  // namespace omnimapper::graph
