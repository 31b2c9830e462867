#pragma once

namespace omnimapper::graph {

/// While such an object exists in any thread, BLAS and OpenMP use one thread for each caller, so that sums are always
/// in the same order and results do not differ in any bit.
class SingleThreadedBlas {
 public:
  SingleThreadedBlas();
  ~SingleThreadedBlas();
  SingleThreadedBlas(const SingleThreadedBlas&) = delete;
  SingleThreadedBlas& operator=(const SingleThreadedBlas&) = delete;
};

}  // namespace omnimapper::graph
