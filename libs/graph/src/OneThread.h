#pragma once

namespace omnimapper::graph {

/// While it lives, BLAS and OpenMP run one thread for the caller: sums in another order are other bits.
class OneThread {
 public:
  OneThread();
  ~OneThread();
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int blas_threads_ = 0;
  int openmp_levels_ = 0;
};

}  // namespace omnimapper::graph
