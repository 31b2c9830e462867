#include "Engine.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace omnimapper::mapper {

namespace {

// Moments that wait for their perception. Not a matter of threads: what is known of the odometry when a moment is
// worked on must not depend on them.
constexpr std::size_t kPipelineDepth = 8;
// How long beyond the window an observation waits for a pose source that lags behind.
constexpr double kPatienceSeconds = 3;

template <class Plugin>
std::vector<const Plugin*> pointers(const std::vector<Named<Plugin>>& plugins) {
  std::vector<const Plugin*> all;
  for (const auto& named : plugins) all.push_back(named.plugin.get());
  return all;
}

}  // namespace

Engine::Engine(const EngineSettings& settings, const std::string& title, SensorPoses sensor_poses, PluginSet plugins,
               int threads)
    : settings_(settings),
      sensor_poses_(std::move(sensor_poses)),
      plugins_(std::move(plugins)),
      trigger_(settings.trigger),
      queue_(base::durationFromSeconds(settings.engine.window)),
      chain_(settings.engine.motion, plugins_.pose, map_, graph_),
      estimator_(settings_, map_, graph_, decisions_),
      reference_sensor_(settings.engine.reference_sensor),
      perception_(pointers(plugins_.extractors), pointers(plugins_.measurement), pool_),
      committer_(plugins_.measurement, map_, graph_, estimator_, decisions_, pool_,
                 static_cast<std::size_t>(settings.engine.job_delay)),
      pool_(std::max(1, threads)) {
  if (plugins_.pose.empty() || plugins_.measurement.empty()) {
    throw base::Error(base::ExitCode::unknown_plugin,
                      "[mapper] names no " +
                          std::string(plugins_.pose.empty() ? "pose_plugins" : "measurement_plugins") +
                          ": a map needs at least one of each; see --list-plugins");
  }
  chain_.beginSession({0, title, {}, true}, std::nullopt, !absoluteOwners().empty());
}

void Engine::add(const mrpt::obs::CObservation::Ptr& observation) {
  const Timed timed(busy_.total);
  ++counts_.observations;
  if (!intake_.accepts(*observation, counts_)) return;
  if (queue_.holds(*observation)) {
    ++counts_.repeated_stamp;
    return;
  }
  queue_.arrived(observation->timestamp);
  const auto placed = sensor_poses_.applied(observation);
  const bool told = tellSources(*placed);
  if (perception_.wants(*placed)) {
    if (!queue_.add(placed)) addLate(placed);
  } else if (!told) {
    ++counts_.unwanted;
  }
  for (auto due = queue_.due(); due && isCovered(*due); due = queue_.due()) release(*queue_.next(), false);
  while (queue_.size() > static_cast<std::size_t>(settings_.engine.queue_limit)) {
    ++counts_.hurried;
    release(*queue_.next(), false);
  }
}

void Engine::finish() {
  // What one plugin throws must not cost the map of what the others did.
  std::exception_ptr failed;
  const auto tried = [&failed](const auto& work) {
    try {
      work();
    } catch (...) {
      if (!failed) failed = std::current_exception();
    }
  };
  {
    const Timed timed(busy_.total);
    while (auto group = queue_.next()) tried([&] { release(*group, false); });
    while (!moments_.empty()) tried([&] { processNext(); });
    while (committer_.jobs() > 0) tried([&] { committer_.applyJobs(true, busy_.jobs); });
    if (!map_.key_frames.empty()) {
      tried([&] { solveNow(settings_.solver.final()); });
      tried([&] { conclude(); });
    }
    tried([&] { collectSections(); });
    if (!window_) tried([&] { judgeMap(); });
  }
  if (extraction_errors_.count() > 0) warn(extraction_errors_.sentence());
  times_.add("perception wait", busy_.perception);
  times_.add("job wait", busy_.jobs);
  times_.add("engine", busy_.total - busy_.perception - busy_.jobs - busy_.plugins - busy_.solve - busy_.outputs);
  if (failed) std::rethrow_exception(failed);
}

// Whether a pose source took it. What it tells anew of the past changes the factors of the key frames there.
bool Engine::tellSources(const mrpt::obs::CObservation& observation) {
  bool taken = false;
  for (auto& [section, plugin] : plugins_.pose) {
    const auto answer = plugin->add(observation);
    counts_.unusable += answer == PosePlugin::Taken::unusable;
    if (answer == PosePlugin::Taken::taken) fed_.insert(section);
    taken = taken || answer != PosePlugin::Taken::not_mine;
    const auto newest = chain_.newest();
    const auto news = plugin->news();
    if (news && newest && news->begin < *newest) chain_.relink(news->begin, news->end);
  }
  return taken;
}

// Whether every continuous source can tell the motion until then. One that has fallen silent is waited for no more.
bool Engine::isCovered(base::Stamp stamp) const {
  const auto patience = base::durationFromSeconds(settings_.engine.window + kPatienceSeconds);
  return std::all_of(plugins_.pose.begin(), plugins_.pose.end(), [&](const auto& named) {
    const auto until = named.plugin->coveredUntil();
    return named.plugin->isFallback() || !until || *until >= stamp || *until + patience < *queue_.now();
  });
}

// Later than its window. Beyond the horizon nobody knows any more how the base moved then.
void Engine::addLate(const mrpt::obs::CObservation::Ptr& observation) {
  const auto newest = chain_.newest();
  if (newest && observation->timestamp + base::durationFromSeconds(settings_.engine.horizon) < *newest) {
    ++counts_.too_late;
    return;
  }
  ++counts_.late;
  release({observation->timestamp, {observation}}, true);
}

// Past the trigger, perception starts at once; the moment itself is worked on when those before it are.
void Engine::release(const ReleaseQueue::Group& group, bool late) {
  for (auto& [section, plugin] : plugins_.pose) {
    const StopWatch watch;
    plugin->processUntil(group.stamp);
    busy_.plugins += watch.seconds();
    times_.add("plugin " + section, watch.seconds());
  }
  const auto motion = [this](base::Stamp begin, base::Stamp end) { return chain_.motion(begin, end, false); };
  Moment moment{group.stamp, false, {}};
  std::vector<mrpt::obs::CObservation::ConstPtr> fired;
  for (const auto& observation : group.observations) {
    const bool fires = late ? trigger_.firesLate(observation->sensorLabel, group.stamp, motion)
                            : trigger_.fires(observation->sensorLabel, group.stamp, motion);
    if (fires) {
      if (reference_sensor_.empty()) reference_sensor_ = observation->sensorLabel;
      fired.push_back(observation);
    } else {
      ++counts_.not_triggered;
    }
    moment.reference = moment.reference || observation->sensorLabel == reference_sensor_;
  }
  for (const auto& raw : fired) moment.observations.push_back(perception_.submit(raw, fired));
  if (moment.observations.empty() && !moment.reference) return;
  moments_.push_back(std::move(moment));
  while (moments_.size() > kPipelineDepth) processNext();
}

// Out of the line first: what throws is not to be met again.
void Engine::processNext() {
  Moment moment = std::move(moments_.front());
  moments_.pop_front();
  process(moment);
}

// What no late observation will ask for: neither one that comes within the horizon, nor one that waits in the line.
void Engine::forget() {
  base::Stamp oldest = *chain_.newest() - base::durationFromSeconds(settings_.engine.horizon);
  for (const auto& moment : moments_) oldest = std::min(oldest, moment.stamp);
  const auto kept = chain_.lastAtOrBefore(oldest);
  if (!kept) return;
  for (auto& [section, plugin] : plugins_.pose) plugin->forgetBefore(*kept);
  trigger_.forgetBefore(*kept);
  if (window_) retire(*kept);
}

void Engine::writeOutputs() {
  std::optional<base::Error> failed;
  for (auto& [section, plugin] : plugins_.output) {
    if (window_ && plugin->isOfMap()) continue;
    const StopWatch watch;
    try {
      plugin->finish(view());
    } catch (const base::Error& error) {
      if (!failed) failed = error;
    }
    times_.add("output " + section, watch.seconds());
  }
  if (failed) throw *failed;
}

}  // namespace omnimapper::mapper
