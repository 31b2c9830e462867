#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/mapper/SavedMap.h>
#include <omnimapper/mapper/SensorPoses.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "RunState.h"
#include "Schedule.h"
#include "back_end/BackEnd.h"
#include "front_end/FrontEnd.h"
#include "sessions/SessionManager.h"

namespace omnimapper::mapper {

/// The mapper (thesis 5.2.3, 5.3.2): observations in, a map out. One thread calls it and is the only writer; workers
/// run extractors, preparations and jobs. What comes out depends on the observations, their order of arrival and the
/// options, never on the workers, unless a schedule of another kind is given.
class Engine {
 public:
  /// Throws Error(unknown_plugin) if no pose plugin or no measurement plugin is given.
  /// `title` names the session.
  Engine(const EngineSettings& settings, const std::string& title, SensorPoses sensor_poses, PluginSet plugins,
         int threads, std::unique_ptr<Schedule> schedule = std::make_unique<Schedule>());

  /// To be called before the first observation if the run continues a saved map or localizes in it.
  SessionManager& sessions() { return sessions_; }
  /// Takes one observation, in order of arrival, and works on whatever that releases. What cannot be used is counted.
  void add(const mrpt::obs::CObservation::Ptr& observation);
  /// Works on whatever the schedule takes by now.
  void poll();
  /// Whether observations had better wait for the workers.
  bool isBusy() const { return front_end_.isFull(); }
  /// The end of the log: everything still queued is worked off, jobs in order, the graph is solved to the end, and the
  /// map is judged.
  void finish();
  /// What is to be said for or against the map as far as it has grown; finish() judges the whole one.
  void judge();
  /// Calls every output plugin's finish(), and gives the errors of those that could not write theirs.
  std::vector<base::Error> writeOutputs();
  /// Whether somebody may still look at an output.
  bool isLookedAt() const;

  /// Asked while a solve runs; true ends it with the best so far (Ctrl-C).
  void setStop(std::function<bool()> stop) { back_end_.setStop(std::move(stop)); }
  /// A sentence for the user: shown by the report and the summary.
  void warn(const std::string& sentence) { state_.warnings.push_back(sentence); }
  /// For the summary: observations that the source did not hand out because nothing can be made of them.
  void setLeftOut(std::size_t observations) { state_.counts.left_out = observations; }
  /// For the summary: how a live run is.
  void setLive(LiveMetrics metrics) { state_.live = std::move(metrics); }
  /// Measures time spent outside the engine, such as reading the log.
  StageTimes::Timer measure(Stage stage) { return state_.times.measure(stage); }

  /// Sections of the measurement plugins that no observation came to, though they work on some.
  std::vector<std::string> idlePlugins() const;
  /// Pose sources that measure, and measurement plugins that give absolute poses, if the log had nothing for any of
  /// them; none if one had, or there are no such plugins at all.
  std::vector<std::string> idleSources() const;
  /// What extractors could not take; finish() warns of it.
  const ExtractionErrors& extractionErrors() const { return state_.extraction_errors; }

  View view() const { return state_.view(); }

 private:
  void process(FrameBundle& bundle);
  void forget();

  EngineSettings settings_;
  PluginSet plugins_;
  RunState state_;
  std::unique_ptr<Schedule> schedule_;
  BackEnd back_end_;
  FrontEnd front_end_;
  SessionManager sessions_;
  // Last, so that it ends first: its tasks use what stands above.
  base::WorkerPool pool_;
};

}  // namespace omnimapper::mapper
