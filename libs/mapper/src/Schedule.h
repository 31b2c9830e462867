#pragma once

#include <cstddef>

#include "FrameBundle.h"

namespace omnimapper::mapper {

/// When the engine takes up what its workers make. This one is that of a log: it counts bundles and key frames, so that
/// the speed of the workers does not show in the map. That of a live run takes what is done.
class Schedule {
 public:
  /// Bundles that wait for their perception. The number of threads plays no part in it: what is known of the odometry
  /// when a bundle is worked on must not depend on them.
  static constexpr std::size_t kPipelineDepth = 8;

  Schedule() = default;
  virtual ~Schedule() = default;
  Schedule(const Schedule&) = delete;
  Schedule& operator=(const Schedule&) = delete;

  /// Whether the oldest of `waiting` bundles is to be worked on now. Who is told yes does so.
  bool takesBundle(const FrameBundle& oldest, std::size_t waiting) {
    return has_ended_ || takesBundleBeforeEnd(oldest, waiting);
  }
  /// Whether the batch of the oldest job is to be applied now; `is_due` by the key frames since, `is_done` by its
  /// worker. Who is told yes does so.
  bool takesJob(bool is_due, bool is_done) { return has_ended_ ? is_due : takesJobBeforeEnd(is_due, is_done); }
  /// No more observations come: from now on all bundles are worked on, and jobs are waited for as on a log.
  void end() { has_ended_ = true; }

  /// A bundle of that stamp is in the map.
  virtual void mapped(base::Stamp /*stamp*/) {}

 private:
  virtual bool takesBundleBeforeEnd(const FrameBundle& /*oldest*/, std::size_t waiting) {
    return waiting > kPipelineDepth;
  }
  virtual bool takesJobBeforeEnd(bool is_due, bool /*is_done*/) { return is_due; }

  bool has_ended_ = false;
};

}  // namespace omnimapper::mapper
