#include <omnimapper/graph/SolveOne.h>
#include <omnimapper/mapper/Engine.h>
#include <omnimapper/mapper/PoseFactors.h>

#include <algorithm>
#include <utility>

namespace omnimapper::mapper {

namespace {

// How long pose plugins keep motion before the newest key frame: sensors slower than this count as without odometry.
constexpr double kHistorySeconds = 30;
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

// Adds the time of its life to a sum.
class Timed {
 public:
  explicit Timed(double& sum) : sum_(sum) {}
  ~Timed() { sum_ += watch_.seconds(); }

 private:
  double& sum_;
  StopWatch watch_;
};

}  // namespace

Engine::Engine(const EngineOptions& options, const TriggerOptions& trigger, const SolverOptions& solver,
               SensorPoses sensor_poses, PluginSet plugins, int threads)
    : options_(options),
      solver_(solver),
      sensor_poses_(std::move(sensor_poses)),
      plugins_(std::move(plugins)),
      trigger_(trigger),
      queue_(base::durationFromSeconds(options.window)),
      pool_(pointers(plugins_.extractors), threads),
      pipeline_depth_(plugins_.extractors.empty() ? 0 : kPipelineDepth),
      graph_(0),
      reference_sensor_(options.reference_sensor) {
  if (plugins_.pose.empty() || plugins_.measurement.empty()) {
    throw base::Error(base::ExitCode::unknown_plugin,
                      "[mapper] names no " +
                          std::string(plugins_.pose.empty() ? "pose_plugins" : "measurement_plugins") +
                          ": a map needs at least one of each; see --list-plugins");
  }
}

void Engine::add(const mrpt::obs::CObservation::Ptr& observation) {
  const Timed timed(busy_.total);
  ++counts_.observations;
  if (!accepts(*observation)) return;
  queue_.arrived(observation->timestamp);
  bool taken = false;
  for (auto& [section, plugin] : plugins_.pose) {
    const auto answer = plugin->add(*observation);
    counts_.unusable += answer == PosePlugin::Taken::unusable;
    taken = taken || answer != PosePlugin::Taken::not_mine;
  }
  if (isWanted(*observation)) {
    if (!queue_.add(sensor_poses_.applied(observation))) ++counts_.too_late;
  } else if (!taken) {
    ++counts_.unwanted;
  }
  for (auto due = queue_.due(); due && isCovered(*due); due = queue_.due()) release(*queue_.next());
}

void Engine::finish() {
  {
    const Timed timed(busy_.total);
    while (auto group = queue_.next()) release(std::move(*group));
    for (; !moments_.empty(); moments_.pop_front()) process(moments_.front());
    if (!map_.key_frames.empty()) solveNow(solver_.final());
  }
  times_.add("perception wait", busy_.perception);
  times_.add("engine", busy_.total - busy_.perception - busy_.plugins - busy_.solve - busy_.outputs);
}

bool Engine::accepts(const mrpt::obs::CObservation& observation) {
  if (!base::isValid(observation.timestamp)) {
    ++counts_.no_stamp;
    return false;
  }
  const auto [last, first] =
      last_stamps_[observation.GetRuntimeClass()].try_emplace(observation.sensorLabel, observation.timestamp);
  if ((!first && last->second == observation.timestamp) || queue_.holds(observation)) {
    ++counts_.repeated_stamp;
    return false;
  }
  last->second = observation.timestamp;
  mrpt::poses::CPose3D base_from_sensor;
  observation.getSensorPose(base_from_sensor);
  if (!base_from_sensor.m_coords.asEigen().allFinite() || !base_from_sensor.getRotationMatrix().asEigen().allFinite()) {
    ++counts_.unusable;
    return false;
  }
  return true;
}

bool Engine::isWanted(const mrpt::obs::CObservation& observation) const {
  return pool_.wants(observation) || std::any_of(plugins_.measurement.begin(), plugins_.measurement.end(),
                                                 [&](const auto& named) { return named.plugin->wants(observation); });
}

// Whether every continuous source can tell the motion until then. One that has fallen silent is waited for no more.
bool Engine::isCovered(base::Stamp stamp) const {
  const auto patience = base::durationFromSeconds(options_.window + kPatienceSeconds);
  return std::all_of(plugins_.pose.begin(), plugins_.pose.end(), [&](const auto& named) {
    const auto until = named.plugin->coveredUntil();
    return named.plugin->isFallback() || !until || *until >= stamp || *until + patience < *queue_.now();
  });
}

// Past the trigger, perception starts at once; the moment itself is worked on when those before it are.
void Engine::release(ReleaseQueue::Group group) {
  const auto motion = [this](base::Stamp begin, base::Stamp end) -> std::optional<RelativeMotion> {
    auto told = motionBetween(begin, end, false);
    if (told.empty()) return std::nullopt;
    return std::move(told.front().second);
  };
  Moment moment{group.stamp, {}};
  bool reference = false;
  for (auto& observation : group.observations) {
    if (trigger_.fires(observation->sensorLabel, group.stamp, motion)) {
      if (reference_sensor_.empty()) reference_sensor_ = observation->sensorLabel;
      moment.observations.push_back({observation, pool_.submit(observation)});
    } else {
      ++counts_.not_triggered;
      reference = reference || observation->sensorLabel == reference_sensor_;
    }
  }
  if (moment.observations.empty() && !reference) return;
  moments_.push_back(std::move(moment));
  while (moments_.size() > pipeline_depth_) {
    process(moments_.front());
    moments_.pop_front();
  }
}

void Engine::process(Moment& moment) {
  if (moment.observations.empty()) {
    hang(moment.stamp);
    return;
  }
  const BusyTimes before = busy_;
  StopWatch watch;
  if (!beginKeyFrame(moment.stamp)) {
    counts_.unconnected += moment.observations.size();
    return;
  }
  const base::KeyFrameId id = map_.key_frames.back().id;
  gather(moment, map_.key_frames.edit(id));
  measure(id);
  for (auto& [section, plugin] : plugins_.pose) {
    plugin->forgetBefore(moment.stamp - base::durationFromSeconds(kHistorySeconds));
  }
  const double plugins = busy_.plugins - before.plugins, solve = busy_.solve - before.solve;
  const double waited = busy_.perception - before.perception;
  times_.keyFrames().push_back({1e3 * plugins, 1e3 * solve, 1e3 * (watch.seconds() - plugins - solve - waited)});
}

bool Engine::beginKeyFrame(base::Stamp stamp) {
  auto& frames = map_.key_frames;
  map::KeyFrame frame;
  frame.id = frames.nextId(0);
  frame.stamp = stamp;
  if (frames.empty()) {
    const bool absolute = std::any_of(plugins_.measurement.begin(), plugins_.measurement.end(),
                                      [](const auto& named) { return named.plugin->givesAbsolutePoses(); });
    frame.pose = graph_.addVariable(poseVariable(options_.motion), poseValue(options_.motion, {}), !absolute);
    // Where measurements place the map, the first pose is only a start: a kilometre and a turn either way.
    const Eigen::Matrix<double, 6, 6> anywhere = 1e6 * Eigen::Matrix<double, 6, 6>::Identity();
    if (absolute) graph_.addFactor(posePrior(options_.motion, frame.pose, {}, anywhere, "engine"));
    frames.insert(std::move(frame));
    uncertainty_ = Uncertainty(graph_);
    return true;
  }
  map::KeyFrame& previous = frames.edit(frames.back().id);
  const auto told = motionBetween(previous.stamp, stamp, true);
  if (told.empty()) return false;
  const auto best = std::min_element(told.begin(), told.end(), [](const auto& a, const auto& b) {
    return a.second.covariance.trace() < b.second.covariance.trace();
  });
  frame.map_from_base = previous.map_from_base + best->second.begin_from_end;
  previous.keyframe_from_next = told.front().second.begin_from_end;
  frame.pose = graph_.addVariable(poseVariable(options_.motion), poseValue(options_.motion, frame.map_from_base));
  for (const auto& [section, motion] : told) {
    graph_.addFactor(betweenPoses(options_.motion, previous.pose, frame.pose, motion, section));
  }
  frames.insert(std::move(frame));
  return true;
}

// The raw observations and what the pool made of them. What a perceived log brought already is not added twice.
void Engine::gather(Moment& moment, map::KeyFrame& frame) {
  const auto isThere = [&](const mrpt::obs::CObservation& derived) {
    return std::any_of(frame.observations.begin(), frame.observations.end(), [&](const auto& other) {
      return other->sensorLabel == derived.sensorLabel && other->GetRuntimeClass() == derived.GetRuntimeClass();
    });
  };
  for (const auto& perceived : moment.observations) frame.observations.push_back(perceived.raw);
  for (auto& perceived : moment.observations) {
    PerceptionPool::Derived derived;
    {
      const Timed timed(busy_.perception);
      derived = perceived.derived.get();
    }
    for (const auto& observation : derived) {
      if (!isThere(*observation)) frame.observations.push_back(observation);
    }
  }
}

void Engine::measure(base::KeyFrameId id) {
  for (auto& [section, plugin] : plugins_.measurement) {
    for (const auto& observation : map_.keyFrame(id).observations) {
      if (!plugin->wants(*observation)) continue;
      const StopWatch watch;
      const Batch batch = plugin->measure(map_.keyFrame(id), {*observation, nullptr}, view());
      times_.add("plugin " + section, watch.seconds());
      busy_.plugins += watch.seconds();
      plugin->applied(applyBatch(batch, section));
    }
  }
  refineNewest();
  const std::size_t since_solve = map_.key_frames.size() - key_frames_at_solve_;
  const auto due = static_cast<std::size_t>(closed_since_solve_ ? options_.solve_after_closure : options_.solve_every);
  if (since_solve >= due) solveNow(solver_.running());
  for (auto& [section, plugin] : plugins_.measurement) {
    const Timed timed(busy_.plugins);
    const FollowUp follow_up = plugin->afterCommit(map_.keyFrame(id), view());
    if (!follow_up.batch.empty()) plugin->applied(applyBatch(follow_up.batch, section));
  }
}

void Engine::hang(base::Stamp stamp) {
  if (map_.key_frames.empty()) {
    ++counts_.unconnected;
    return;
  }
  map::KeyFrame& frame = map_.key_frames.edit(map_.key_frames.back().id);
  const bool first = frame.hanging.empty();
  const base::Stamp begin = first ? frame.stamp : frame.hanging.back().stamp;
  const auto told = motionBetween(begin, stamp, true);
  if (told.empty()) {
    ++counts_.unconnected;
    return;
  }
  const auto& start = first ? mrpt::poses::CPose3D() : frame.hanging.back().keyframe_from_base;
  frame.hanging.push_back({stamp, start + told.front().second.begin_from_end});
}

std::vector<std::pair<std::string, RelativeMotion>> Engine::motionBetween(base::Stamp begin, base::Stamp end,
                                                                          bool or_fallback) const {
  std::vector<std::pair<std::string, RelativeMotion>> told;
  for (const bool fallback : {false, true}) {
    if (fallback && (!told.empty() || !or_fallback)) break;
    for (const auto& [section, plugin] : plugins_.pose) {
      if (plugin->isFallback() != fallback) continue;
      if (const auto motion = plugin->between(begin, end)) told.emplace_back(section, *motion);
    }
  }
  return told;
}

AppliedBatch Engine::applyBatch(const Batch& batch, const std::string& owner) {
  auto ids = apply(batch, {owner, map_.key_frames.back().stamp}, graph_, map_);
  decisions_.insert(decisions_.end(), batch.decisions().begin(), batch.decisions().end());
  closed_since_solve_ = closed_since_solve_ || std::any_of(batch.addedFactors().begin(), batch.addedFactors().end(),
                                                           [](const auto& record) { return record.tags.hypothesis; });
  return ids;
}

// The newest pose by all factors that bind it to the poses before, which stay: what a solve would do first.
void Engine::refineNewest() {
  map::KeyFrame& frame = map_.key_frames.edit(map_.key_frames.back().id);
  graph::solveOne(graph_, frame.pose);
  frame.map_from_base = poseOf(graph_, frame.pose);
}

void Engine::solveNow(const graph::SolveOptions& options) {
  const StopWatch watch;
  const auto summary = graph::solve(graph_, options);
  for (std::size_t i = 0; i < map_.key_frames.size(); ++i) {
    auto& frame = map_.key_frames.edit(map_.key_frames[i].id);
    frame.map_from_base = poseOf(graph_, frame.pose);
  }
  uncertainty_ = Uncertainty(graph_);
  busy_.solve += watch.seconds();
  times_.add("solve", watch.seconds());
  ++counts_.solves;
  solves_.push_back(
      {map_.key_frames.size(), graph_.factors().size(), summary.initial_cost, summary.final_cost, summary.iterations});
  key_frames_at_solve_ = map_.key_frames.size();
  closed_since_solve_ = false;
  for (auto& [section, plugin] : plugins_.output) {
    const StopWatch shown;
    plugin->update(view());
    busy_.outputs += shown.seconds();
    times_.add("output " + section, shown.seconds());
  }
}

void Engine::writeOutputs() {
  std::optional<base::Error> failed;
  for (auto& [section, plugin] : plugins_.output) {
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
