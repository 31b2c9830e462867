#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/mapper/Extractor.h>
#include <omnimapper/mapper/MeasurementPlugin.h>

#include <future>
#include <memory>
#include <vector>

namespace omnimapper::mapper {

/// An observation with what each measurement plugin prepared of it, by the plugins' order; null where that is nothing.
struct Perceived {
  mrpt::obs::CObservation::ConstPtr observation;
  std::vector<std::unique_ptr<const Prepared>> prepared;
};

/// What happens to an observation in the worker pool, ahead of the engine: extractors derive observations from it, and
/// measurement plugins prepare what they want of it and of those. Depends on the observation alone.
class Perception {
 public:
  /// All of them stay the caller's and must outlive this, and this the tasks in the pool.
  Perception(std::vector<const Extractor*> extractors, std::vector<const MeasurementPlugin*> plugins,
             base::WorkerPool& pool)
      : extractors_(std::move(extractors)), plugins_(std::move(plugins)), pool_(pool) {}

  /// Whether an extractor or a plugin takes it.
  bool wants(const mrpt::obs::CObservation& raw) const;
  /// `raw` itself, then what the extractors make of it, in their order. Exceptions come out of the future.
  std::future<std::vector<Perceived>> submit(mrpt::obs::CObservation::ConstPtr raw) const;

 private:
  Perceived prepared(mrpt::obs::CObservation::ConstPtr observation) const;

  std::vector<const Extractor*> extractors_;
  std::vector<const MeasurementPlugin*> plugins_;
  base::WorkerPool& pool_;
};

}  // namespace omnimapper::mapper
