#pragma once

#include <cstddef>

#include "FrameBundle.h"

namespace omnimapper::mapper {

/// Decides when the engine uses the results of its workers. This class serves logs: it counts bundles and key frames,
/// so that the speed of the workers does not change the map. The schedule of a live run uses results as soon as they
/// are done.
class Schedule {
 public:
  /// Number of bundles that wait for their perception. It does not depend on the number of threads, because it
  /// determines how much odometry is known when a bundle is processed.
  static constexpr std::size_t kPipelineDepth = 8;

  Schedule() = default;
  virtual ~Schedule() = default;
  Schedule(const Schedule&) = delete;
  Schedule& operator=(const Schedule&) = delete;

  /// Whether the oldest of `waiting` bundles is to be processed now. After a result of true the caller must process it.
  bool takesBundle(const FrameBundle& oldest, std::size_t waiting) {
    return has_ended_ || takesBundleBeforeEnd(oldest, waiting);
  }
  /// Whether the batch of the oldest job is to be applied now. `is_due`: enough key frames have been added since;
  /// `is_done`: its worker has finished. After a result of true the caller must apply it.
  bool takesJob(bool is_due, bool is_done) {
    return has_ended_ || is_draining_ ? is_due : takesJobBeforeEnd(is_due, is_done);
  }
  /// Called when no more observations will come: from then on all bundles are processed, and jobs are waited for as on
  /// a log.
  void end() { has_ended_ = true; }

  /// While set, all bundles are processed as at the end, and nothing is noted.
  void setDraining(bool is_draining) { is_draining_ = is_draining; }

  /// Called when the bundle of that stamp has become part of the map.
  virtual void mapped(base::Stamp /*stamp*/) {}

 private:
  virtual bool takesBundleBeforeEnd(const FrameBundle& /*oldest*/, std::size_t waiting) {
    return waiting > kPipelineDepth;
  }
  virtual bool takesJobBeforeEnd(bool is_due, bool /*is_done*/) { return is_due; }

  bool has_ended_ = false, is_draining_ = false;
};

}  // namespace omnimapper::mapper
