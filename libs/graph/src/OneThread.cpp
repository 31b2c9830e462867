#include "OneThread.h"

#include <dlfcn.h>

namespace omnimapper::graph {

namespace {

/// Which BLAS and whether OpenMP is loaded is known only at run time.
int call(const char* getter) {
  const auto get = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, getter));
  return get ? get() : 0;
}

void call(const char* setter, int threads) {
  const auto set = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, setter));
  if (set && threads > 0) set(threads);
}

}  // namespace

OneThread::OneThread() : blas_threads_(call("openblas_get_num_threads")), openmp_threads_(call("omp_get_max_threads")) {
  call("openblas_set_num_threads", 1);
  call("omp_set_num_threads", 1);
}

OneThread::~OneThread() {
  call("openblas_set_num_threads", blas_threads_);
  call("omp_set_num_threads", openmp_threads_);
}

}  // namespace omnimapper::graph
