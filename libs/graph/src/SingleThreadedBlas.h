#pragma once

namespace omnimapper::graph {

/// While one lives in any thread, BLAS and OpenMP run one thread for each caller: sums in another order are other bits.
class SingleThreadedBlas {
 public:
  SingleThreadedBlas();
  ~SingleThreadedBlas();
  SingleThreadedBlas(const SingleThreadedBlas&) = delete;
  SingleThreadedBlas& operator=(const SingleThreadedBlas&) = delete;
};

}  // namespace omnimapper::graph
