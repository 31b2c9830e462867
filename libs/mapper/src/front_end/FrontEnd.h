#pragma once

#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/mapper/SensorPoses.h>
#include <omnimapper/mapper/Trigger.h>
#include <omnimapper/plugin/WatchesObservations.h>

#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "FrameBundle.h"
#include "RunState.h"
#include "Schedule.h"
#include "back_end/PoseChain.h"
#include "front_end/InputFilter.h"
#include "front_end/Perception.h"
#include "front_end/ReleaseQueue.h"

namespace omnimapper::mapper {

/// Takes observations in order of arrival and returns bundles for key frames, in order of time except for late ones
/// (thesis 5.2.3.2, 5.3.2.1). It also feeds the pose sources, and starts the perception of a bundle in the worker pool
/// when the trigger lets it through.
class FrontEnd {
 public:
  /// The caller owns all arguments but `sensor_poses`. `chain` gives the trigger the motion of the base and is informed
  /// when a pose source corrects the past.
  FrontEnd(const EngineSettings& settings, SensorPoses sensor_poses, PluginSet& plugins, PoseChain& chain,
           base::WorkerPool& pool, Schedule& schedule, RunState& state);

  /// Takes one observation of a sensor or of a watcher. Unusable ones are counted.
  void add(const Arrival& arrival);
  /// Called at the end of the log: from then on next() returns everything that still waits.
  void close();
  /// The bundle to process now; none until more observations are added. It must be processed before the next call,
  /// because the trigger needs the motion of the base up to it.
  std::optional<FrameBundle> next();

  /// The oldest of the bundles whose perception was started, whatever the schedule says; none if there are none.
  std::optional<FrameBundle> nextOfAll();
  /// Must be called after plugins or extractors were added or removed, while no bundle is in perception.
  void pluginsChanged();

  /// Whether enough bundles wait for their perception that no more should be started.
  bool isFull() const { return in_perception_ > Schedule::kPipelineDepth; }
  /// Earliest stamp of the waiting bundles; late ones stand behind younger ones.
  std::optional<base::Stamp> oldestWaiting() const;
  /// Lets pose sources and trigger drop their data from before `stamp`.
  void forgetBefore(base::Stamp stamp);

 private:
  bool feedSources(const mrpt::obs::CObservation::ConstPtr& observation);
  mrpt::obs::CObservation::ConstPtr usablePart(mrpt::obs::CObservation::ConstPtr observation) const;
  bool isCovered(base::Stamp stamp) const;
  bool tellWatchers(const mrpt::obs::CObservation& observation) const;
  bool isWatched(const mrpt::obs::CObservation& observation) const;
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
  std::optional<Perception> perception_;  // of the present plugins and extractors
  base::WorkerPool& pool_;
  std::vector<WatchesObservations*> watchers_;
  std::vector<HearsObservations*> hearers_;
  bool only_moves_ = false;  // no measurement plugin takes or watches observations
  std::unordered_map<const mrpt::obs::CObservation*, int> generation_of_;  // of the queued ones that watchers made
  std::string reference_sensor_;
  std::deque<FrameBundle> bundles_;
  std::size_t in_perception_ = 0;  // of the bundles: all but those that are only watched
  bool closed_ = false;
};

}  // namespace omnimapper::mapper
