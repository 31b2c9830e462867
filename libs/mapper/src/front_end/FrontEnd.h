#pragma once

#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/mapper/SensorPoses.h>
#include <omnimapper/mapper/Trigger.h>

#include <deque>
#include <optional>
#include <string>

#include "FrameBundle.h"
#include "RunState.h"
#include "Schedule.h"
#include "back_end/PoseChain.h"
#include "front_end/InputFilter.h"
#include "front_end/Perception.h"
#include "front_end/ReleaseQueue.h"

namespace omnimapper::mapper {

/// Observations in, in order of arrival; bundles for key frames out, in order of time except for late ones (thesis
/// 5.2.3.2, 5.3.2.1). Pose sources are fed on the way, and perception of a bundle starts in the worker pool when the
/// trigger lets it through.
class FrontEnd {
 public:
  /// All but `sensor_poses` stay the caller's. `chain` answers the trigger how the base moved, and learns of what pose
  /// sources correct.
  FrontEnd(const EngineSettings& settings, SensorPoses sensor_poses, PluginSet& plugins, PoseChain& chain,
           base::WorkerPool& pool, Schedule& schedule, RunState& state);

  /// Takes one observation. What cannot be used is counted.
  void add(const mrpt::obs::CObservation::Ptr& observation);
  /// The log has ended: next() hands out all that still waits.
  void close();
  /// The bundle to work on now; none until more is added. Process it before the next call: the trigger asks how the
  /// base moved until then.
  std::optional<FrameBundle> next();

  /// Whether so many bundles wait for their perception that no more are begun.
  bool isFull() const { return bundles_.size() > Schedule::kPipelineDepth; }
  /// Stamp of the oldest bundle that waits to be handed out; late ones stand behind younger ones.
  std::optional<base::Stamp> oldestWaiting() const;
  /// Lets pose sources and trigger drop what they keep of the time before `stamp`.
  void forgetBefore(base::Stamp stamp);

 private:
  bool feedSources(const mrpt::obs::CObservation::ConstPtr& observation);
  bool isCovered(base::Stamp stamp) const;
  void addLate(const mrpt::obs::CObservation::Ptr& observation);
  bool releaseNext();
  void release(const ReleaseQueue::Group& group, bool late);

  const EngineOptions& options_;
  SensorPoses sensor_poses_;
  PluginSet& plugins_;
  PoseChain& chain_;
  Schedule& schedule_;
  RunState& state_;
  InputFilter filter_;
  ReleaseQueue queue_;
  Trigger trigger_;
  Perception perception_;
  std::string reference_sensor_;
  std::deque<FrameBundle> bundles_;
  bool closed_ = false;
};

}  // namespace omnimapper::mapper
