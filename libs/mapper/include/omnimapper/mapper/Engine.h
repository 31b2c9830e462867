#pragma once

#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/PerceptionPool.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/mapper/ReleaseQueue.h>
#include <omnimapper/mapper/SensorPoses.h>
#include <omnimapper/mapper/Trigger.h>
#include <omnimapper/mapper/View.h>

#include <deque>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// The mapper (thesis 5.2.3, 5.3.2): observations in, a map out. One thread calls it and is the only writer; workers
/// run the extractors. What comes out depends on the observations and the options, never on the workers.
class Engine {
 public:
  /// Throws Error(unknown_plugin) if no pose plugin or no measurement plugin is given.
  Engine(const EngineOptions& options, const TriggerOptions& trigger, const SolverOptions& solver,
         SensorPoses sensor_poses, PluginSet plugins, int threads);

  /// Takes one observation, in order of arrival, and works on whatever that releases. What cannot be used is counted.
  void add(const mrpt::obs::CObservation::Ptr& observation);
  /// The end of the log: everything still queued is worked off, the graph is solved to the end.
  void finish();
  /// Calls every output plugin's finish(). An output that cannot be written does not keep the others from theirs; the
  /// first error is thrown at the end.
  void writeOutputs();

  /// A sentence for the user: shown by the report and the summary.
  void warn(const std::string& sentence) { warnings_.push_back(sentence); }
  /// Adds time spent outside the engine, such as reading the log.
  void addTime(const std::string& stage, double seconds) { times_.add(stage, seconds); }

  View view() const { return {{map_, graph_, uncertainty_}, decisions_, times_, counts_, solves_, warnings_, sections_}; }

 private:
  /// An observation with the derived ones that the pool is making of it.
  struct Perceived {
    mrpt::obs::CObservation::Ptr raw;
    std::future<PerceptionPool::Derived> derived;
  };
  /// All observations of one stamp, past the trigger. Without any, the stamp only hangs on its key frame.
  struct Moment {
    base::Stamp stamp;
    std::vector<Perceived> observations;
  };

  bool accepts(const mrpt::obs::CObservation& observation);
  bool isWanted(const mrpt::obs::CObservation& observation) const;
  bool isCovered(base::Stamp stamp) const;
  void release(ReleaseQueue::Group group);
  void process(Moment& moment);
  bool beginKeyFrame(base::Stamp stamp);
  void gather(Moment& moment, map::KeyFrame& frame);
  void measure(base::KeyFrameId id);
  void hang(base::Stamp stamp);
  /// What each source that covers the span says, by section; the fallbacks if none does and they are asked for.
  std::vector<std::pair<std::string, RelativeMotion>> motionBetween(base::Stamp begin, base::Stamp end,
                                                                    bool or_fallback) const;
  AppliedBatch applyBatch(const Batch& batch, const std::string& owner);
  void refineNewest();
  void solveNow(const graph::SolveOptions& options);

  /// Seconds in the engine's thread.
  struct BusyTimes {
    double total = 0, perception = 0, plugins = 0, solve = 0, outputs = 0;
  };

  EngineOptions options_;
  SolverOptions solver_;
  SensorPoses sensor_poses_;
  PluginSet plugins_;
  Trigger trigger_;
  ReleaseQueue queue_;
  std::deque<Moment> moments_;
  PerceptionPool pool_;
  std::size_t pipeline_depth_;

  map::Map map_;
  graph::Graph graph_;
  Uncertainty uncertainty_;
  std::vector<map::MapSection> sections_;
  DecisionLog decisions_;
  StageTimes times_;
  RunCounts counts_;
  std::vector<SolveRecord> solves_;
  std::vector<std::string> warnings_;
  std::string reference_sensor_;
  std::map<const mrpt::rtti::TRuntimeClassId*, std::map<std::string, base::Stamp>> last_stamps_;  // by class and label
  BusyTimes busy_;
  std::size_t key_frames_at_solve_ = 0;
  bool closed_since_solve_ = false;
};

}  // namespace omnimapper::mapper
