#pragma once

namespace omnimapper::graph {

/// While one lives in any thread, BLAS and OpenMP run one thread for each caller: sums in another order are other bits.
class OneThread {
 public:
  OneThread();
  ~OneThread();
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;
};

}  // namespace omnimapper::graph
