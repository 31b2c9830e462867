#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/perception/Extractor.h>
#include <omnimapper/plugin/MeasurementPlugin.h>

#include <future>
#include <memory>
#include <vector>

#include "FrameBundle.h"

namespace omnimapper::mapper {

/// What happens to an observation in the worker pool, ahead of the engine: extractors derive observations from it, and
/// measurement plugins prepare what they want of it and of those. Depends on the observation, and on those given with
/// it, alone.
class Perception {
 public:
  /// All of them stay the caller's and must outlive this, and this the tasks in the pool.
  Perception(std::vector<const perception::Extractor*> extractors, std::vector<const MeasurementPlugin*> plugins,
             base::WorkerPool& pool, const CloudOptions& cloud)
      : extractors_(std::move(extractors)), plugins_(std::move(plugins)), pool_(pool), cloud_(cloud) {}

  /// Whether an extractor or a plugin takes it.
  bool wants(const mrpt::obs::CObservation& raw) const;
  /// Extractors all of whose results are among `brought`, observations of the same stamp that came with the log, are
  /// spared. What they throw as base::Error is in the result; other exceptions come out of the future.
  std::future<PerceivedParts> submit(mrpt::obs::CObservation::ConstPtr raw,
                                     std::vector<mrpt::obs::CObservation::ConstPtr> brought = {}) const;

 private:
  Perceived prepared(mrpt::obs::CObservation::ConstPtr observation) const;

  std::vector<const perception::Extractor*> extractors_;
  std::vector<const MeasurementPlugin*> plugins_;
  base::WorkerPool& pool_;
  CloudOptions cloud_;
};

}  // namespace omnimapper::mapper
