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

/// Processes observations in the worker pool, ahead of the engine: extractors derive observations, and measurement
/// plugins prepare the raw and derived ones that they want. The result depends only on the observation and on those
/// passed with it.
class Perception {
 public:
  /// The caller owns all arguments; they must outlive this object, and this object must outlive its tasks in the pool.
  Perception(std::vector<const perception::Extractor*> extractors, std::vector<const MeasurementPlugin*> plugins,
             base::WorkerPool& pool, const CloudOptions& cloud)
      : extractors_(std::move(extractors)), plugins_(std::move(plugins)), pool_(pool), cloud_(cloud) {}

  /// Whether any extractor or plugin wants the observation.
  bool wants(const mrpt::obs::CObservation& raw) const;
  /// Starts the processing of `raw`. `brought` are the observations of the same stamp that came with the log; an
  /// extractor whose results are all among them is skipped. A base::Error of an extractor is part of the result; other
  /// exceptions come out of the future. `board` has what pose plugins made of `raw`.
  std::future<PerceivedParts> submit(mrpt::obs::CObservation::ConstPtr raw,
                                     std::vector<mrpt::obs::CObservation::ConstPtr> brought = {},
                                     perception::Blackboard board = {}) const;

 private:
  Perceived prepared(mrpt::obs::CObservation::ConstPtr observation, const perception::Blackboard& board) const;

  std::vector<const perception::Extractor*> extractors_;
  std::vector<const MeasurementPlugin*> plugins_;
  base::WorkerPool& pool_;
  CloudOptions cloud_;
};

}  // namespace omnimapper::mapper
