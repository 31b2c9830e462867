#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/mapper/Extractor.h>

#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace omnimapper::mapper {

/// Worker threads that run extractors ahead of the engine. What comes out depends on what goes in, never on threads.
class PerceptionPool {
 public:
  using Derived = std::vector<mrpt::obs::CObservation::Ptr>;

  /// `extractors` stay the caller's and must outlive the pool. threads >= 1.
  PerceptionPool(std::vector<const Extractor*> extractors, int threads);
  /// Finishes what was submitted.
  ~PerceptionPool();
  PerceptionPool(const PerceptionPool&) = delete;
  PerceptionPool& operator=(const PerceptionPool&) = delete;

  bool wants(const mrpt::obs::CObservation& raw) const;
  /// All that the extractors make of `raw`, in their order. An extractor's exception comes out of the future.
  std::future<Derived> submit(mrpt::obs::CObservation::ConstPtr raw);

 private:
  void work();

  std::vector<const Extractor*> extractors_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::packaged_task<Derived()>> tasks_;
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace omnimapper::mapper
