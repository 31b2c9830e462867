#pragma once

#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/graph/Graph.h>
#include <omnimapper/map/Map.h>
#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/mapper/SavedMap.h>
#include <omnimapper/mapper/SensorPoses.h>
#include <omnimapper/mapper/Trigger.h>
#include <omnimapper/plugin/View.h>

#include <deque>
#include <functional>
#include <future>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "back_end/BatchApplier.h"
#include "back_end/Estimator.h"
#include "back_end/PoseChain.h"
#include "back_end/SlidingWindow.h"
#include "front_end/InputFilter.h"
#include "front_end/Perception.h"
#include "front_end/ReleaseQueue.h"

namespace omnimapper::mapper {

/// The mapper (thesis 5.2.3, 5.3.2): observations in, a map out. One thread calls it and is the only writer; workers
/// run extractors, preparations and jobs. What comes out depends on the observations, their order of arrival and the
/// options, never on the workers.
class Engine {
 public:
  /// Throws Error(unknown_plugin) if no pose plugin or no measurement plugin is given.
  /// `title` names the session.
  Engine(const EngineSettings& settings, const std::string& title, SensorPoses sensor_poses, PluginSet plugins,
         int threads);

  /// Before the first observation: takes up a map as it was saved; what follows is a new session of it, which begins
  /// at `start`. Throws Error(unreadable_input) if a plugin cannot make use of its section.
  void continueFrom(SavedMap saved, const SessionStart& start);
  /// As continueFrom(), but the map is held as it is: what follows is only localized in it, and no more than about
  /// `key_frames` of it are kept free.
  void localizeIn(SavedMap saved, const SessionStart& start, int key_frames);
  /// Takes one observation, in order of arrival, and works on whatever that releases. What cannot be used is counted.
  void add(const mrpt::obs::CObservation::Ptr& observation);
  /// The end of the log: everything still queued is worked off, jobs in order, the graph is solved to the end, and the
  /// map is judged.
  void finish();
  /// Calls every output plugin's finish(). An output that cannot be written does not keep the others from theirs; the
  /// first error is thrown at the end.
  void writeOutputs();

  /// Asked while a solve runs; true ends it with the best so far (Ctrl-C).
  void setStop(std::function<bool()> stop) { estimator_.setStop(std::move(stop)); }
  /// A sentence for the user: shown by the report and the summary.
  void warn(const std::string& sentence) { warnings_.push_back(sentence); }
  /// For the summary: observations that the source did not hand out because nothing can be made of them.
  void setLeftOut(std::size_t observations) { counts_.left_out = observations; }
  /// Adds time spent outside the engine, such as reading the log.
  void addTime(const std::string& stage, double seconds) { times_.add(stage, seconds); }

  /// Sections of the measurement plugins that no observation came to, though they work on some.
  std::vector<std::string> idlePlugins() const;
  /// Pose sources that measure, and measurement plugins that give absolute poses, if the log had nothing for any of
  /// them; none if one had, or there are no such plugins at all.
  std::vector<std::string> idleSources() const;
  /// What extractors could not take; finish() warns of it.
  const ExtractionErrors& extractionErrors() const { return extraction_errors_; }

  View view() const {
    return {{map_, graph_, estimator_.uncertainty()},
            decisions_,
            times_,
            counts_,
            estimator_.solves(),
            warnings_,
            sections_,
            window_.has_value(),
            fixes_,
            verdict_};
  }

 private:
  /// All observations of one stamp, past the trigger. Without any, the stamp only hangs on its key frame.
  struct Moment {
    base::Stamp stamp;
    bool reference;  // one of them, or of those that hang, is of the reference sensor
    std::vector<std::future<PerceivedParts>> observations;  // what the pool makes of each
  };

  bool isCovered(base::Stamp stamp) const;
  bool tellSources(const mrpt::obs::CObservation& observation);
  void release(const ReleaseQueue::Group& group, bool late);
  void addLate(const mrpt::obs::CObservation::Ptr& observation);
  void processNext();
  void process(Moment& moment);
  void forget();
  void retire(base::Stamp stamp);
  void noteFix(base::KeyFrameId id);
  std::vector<Perceived> gather(Moment& moment, base::KeyFrameId id);
  void measure(base::KeyFrameId id, const std::vector<Perceived>& perceived);
  void commit(base::KeyFrameId id);
  void conclude();
  void solveNow(const graph::SolveOptions& options);
  void collectSections();
  void judgeMap();
  void takeUp(SavedMap saved, const SessionStart& start);
  void restorePlugins();
  std::set<std::string> absoluteOwners() const;

  /// Seconds in the engine's thread.
  struct BusyTimes {
    double total = 0, perception = 0, plugins = 0, jobs = 0, solve = 0, outputs = 0;
  };

  EngineSettings settings_;
  SensorPoses sensor_poses_;
  PluginSet plugins_;
  InputFilter intake_;
  Trigger trigger_;
  ReleaseQueue queue_;
  std::deque<Moment> moments_;

  map::Map map_;
  graph::Graph graph_;
  DecisionLog decisions_;
  PoseChain chain_;
  Estimator estimator_;
  StageTimes times_;
  RunCounts counts_;
  std::vector<std::string> warnings_;
  ExtractionErrors extraction_errors_;
  std::vector<map::MapSection> sections_;
  std::string reference_sensor_;
  std::set<std::string> fed_;  // pose sources and measurement plugins that an observation came to
  BusyTimes busy_;
  std::optional<SlidingWindow> window_;  // of a run that localizes
  std::vector<LocalizationEstimate> fixes_;
  Verdict verdict_;

  Perception perception_;
  BatchApplier committer_;
  // Last, so that it ends first: its tasks use what stands above.
  base::WorkerPool pool_;
};

}  // namespace omnimapper::mapper
