#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/derived/SavedMap.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/PluginRegistry.h>
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

/// The mapper (thesis 5.2.3, 5.3.2): takes observations and builds a map. It is called from one thread, which alone
/// writes the map and the graph; workers run extractors, preparations and jobs. The result depends on the observations,
/// their order of arrival and the options, but not on the workers, unless a schedule of another kind is given.
class Engine {
 public:
  /// `title` names the session. Throws Error(unknown_plugin) if no pose plugin is given.
  Engine(const EngineSettings& settings, const std::string& title, SensorPoses sensor_poses, PluginSet plugins,
         int threads, std::unique_ptr<Schedule> schedule = std::make_unique<Schedule>());

  /// Must be called before the first observation if the run continues a saved map or localizes in it.
  SessionManager& sessions() { return sessions_; }
  /// Takes one observation, in order of arrival, and processes every bundle that it releases. Unusable ones are
  /// counted.
  void add(const mrpt::obs::CObservation::Ptr& observation);
  /// Processes the bundles that the schedule releases by now.
  void poll();
  /// Whether new observations should wait until the workers have caught up.
  bool isBusy() const { return front_end_.isFull(); }
  /// Removes and adds plugins between two bundles. Everything in perception, and every job, is finished first, so the
  /// result depends only on the observations before the call. What a removed plugin made stays, and so does its
  /// evidence; its state is saved as if the map were written, and a plugin of the same section that is added later, in
  /// this run or in one that continues the map, goes on from it. Returns why the new plugins cannot be used, and all
  /// plugins stay as they were then; empty if they changed. Throws what the work that was to be finished throws. A pose
  /// plugin must stay that is neither removed nor made anew, because a new one does not know the motion since the last
  /// key frame.
  std::string changePlugins(PluginChange change);
  /// The plugins of the run as they are now.
  const PluginSet& plugins() const { return plugins_; }
  /// Called at the end of the log: processes everything that is still queued, applies the jobs in order, solves the
  /// graph with the final options and judges the map.
  void finish();
  /// Collects the evidence for and against the map as it is now; finish() does this for the whole map.
  void judge();
  /// Evidence on the observations, which counts for the verdict.
  void setInputEvidence(std::vector<Evidence> evidence) { back_end_.evidence().setOfInput(std::move(evidence)); }
  /// Calls finish() of every output plugin and returns the errors of those that could not write their output.
  std::vector<base::Error> writeOutputs();
  /// Whether a window still shows the map to the user.
  bool isLookedAt() const;

  /// `stop` is called while a solve runs; if it returns true, the solve ends with its best values so far (Ctrl-C).
  void setStop(std::function<bool()> stop) { back_end_.setStop(std::move(stop)); }
  /// Adds a warning, a sentence for the user that the report and the summary show.
  void warn(const std::string& sentence) { state_.warnings.push_back(sentence); }
  /// Notes in the decision log what the user did during the run: half a sentence.
  void note(const std::string& what);
  /// Sets the number of observations that the source discarded as unusable; the summary shows it.
  void setLeftOut(std::size_t observations) { state_.counts.left_out = observations; }
  /// Sets the metrics of a live run that the summary shows.
  void setLive(LiveMetrics metrics) { state_.live = std::move(metrics); }
  /// Sets the wall time that the map took, for the outputs.
  void setMappingSeconds(double seconds) { state_.times.setMappingSeconds(seconds); }
  /// Measures time spent outside the engine, such as reading the log.
  StageTimes::Timer measure(Stage stage) { return state_.times.measure(stage); }

  /// Sections of the measurement plugins that use observations but received none.
  std::vector<std::string> idlePlugins() const;
  /// Sections of the pose sources that measure and of the measurement plugins that give absolute poses, if none of them
  /// received an observation; empty if one did, or if the INI names no such plugins.
  std::vector<std::string> idleSources() const;
  /// The errors of the extractors; finish() warns of them.
  const ExtractionErrors& extractionErrors() const { return state_.extraction_errors; }

  View view() const { return state_.view(); }

 private:
  void process(FrameBundle& bundle);
  void takeAnswers(const FrameBundle& bundle);
  void drain();
  std::string whyNotChanged(const PluginChange& change);
  void exchangePlugins(PluginChange& change);
  void forget();

  EngineSettings settings_;
  PluginSet plugins_;
  RunState state_;
  SharedResults shared_;  // of the finished map
  std::unique_ptr<Schedule> schedule_;
  BackEnd back_end_;
  FrontEnd front_end_;
  SessionManager sessions_;
  // Declared last so that it is destroyed first: its tasks use the members above.
  base::WorkerPool pool_;
};

}  // namespace omnimapper::mapper
