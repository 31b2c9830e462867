#include "front_end/FrontEnd.h"

#include <omnimapper/base/Stamp.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace omnimapper::mapper {

namespace {

// How much longer than the window an observation waits for a pose source that lags behind.
constexpr double kPatienceSeconds = 3;

template <class Plugin>
std::vector<const Plugin*> pointers(const std::vector<Named<Plugin>>& plugins) {
  std::vector<const Plugin*> all;
  for (const auto& named : plugins) all.push_back(named.plugin.get());
  return all;
}

// The plugins that implement an interface.
template <class Interface>
std::vector<Interface*> thatAre(const std::vector<Named<MeasurementPlugin>>& plugins) {
  std::vector<Interface*> all;
  for (const auto& named : plugins) {
    if (auto* is = dynamic_cast<Interface*>(named.plugin.get())) all.push_back(is);
  }
  return all;
}

}  // namespace

FrontEnd::FrontEnd(const EngineSettings& settings, SensorPoses sensor_poses, PluginSet& plugins, PoseChain& chain,
                   base::WorkerPool& pool, Schedule& schedule, RunState& state)
    : options_(settings.engine),
      sensor_poses_(std::move(sensor_poses)),
      plugins_(plugins),
      chain_(chain),
      schedule_(schedule),
      state_(state),
      queue_(base::durationFromSeconds(settings.engine.window)),
      trigger_(settings.trigger),
      pool_(pool),
      reference_sensor_(settings.engine.reference_sensor) {
  pluginsChanged();
}

void FrontEnd::pluginsChanged() {
  perception_.emplace(pointers(plugins_.extractors), pointers(plugins_.measurement), pool_, options_.cloud());
  watchers_ = thatAre<WatchesObservations>(plugins_.measurement);
  hearers_ = thatAre<HearsObservations>(plugins_.measurement);
  only_moves_ = watchers_.empty() && std::all_of(plugins_.measurement.begin(), plugins_.measurement.end(),
                                                 [](const auto& named) { return named.plugin->worksOnLandmarks(); });
}

void FrontEnd::add(const Arrival& arrival) {
  const auto& observation = arrival.observation;
  RunCounts& counts = state_.counts;
  ++counts.observations;
  if (!filter_.accepts(*observation, counts)) return;
  if (queue_.holds(*observation)) {
    ++counts.repeated_stamp;
    return;
  }
  queue_.arrived(observation->timestamp);
  const auto placed = sensor_poses_.applied(observation);
  const bool is_taken = feedSources(placed);
  for (auto* hearer : hearers_) hearer->heard(*placed);
  const bool is_watched = tellWatchers(*placed);
  // If no measurement plugin takes or watches observations, those of the pose sources make the key frames.
  if (is_watched || perception_->wants(*placed) || (is_taken && only_moves_)) {
    generation_of_.erase(placed.get());
    if (is_watched && arrival.generation > 0) generation_of_[placed.get()] = arrival.generation;
    if (!queue_.add(placed)) addLate(placed);
  } else if (!is_taken) {
    ++counts.unwanted;
  }
}

// Whether any plugin watches the observation.
bool FrontEnd::tellWatchers(const mrpt::obs::CObservation& observation) const {
  bool is_watched = false;
  for (auto* watcher : watchers_) {
    if (!watcher->watches(observation)) continue;
    watcher->arrived(observation);
    is_watched = true;
  }
  return is_watched;
}

bool FrontEnd::isWatched(const mrpt::obs::CObservation& observation) const {
  return std::any_of(watchers_.begin(), watchers_.end(),
                     [&](const auto* watcher) { return watcher->watches(observation); });
}

// Whether a pose source took the observation. If a source has new information on the past, the factors there are
// replaced.
bool FrontEnd::feedSources(const mrpt::obs::CObservation::ConstPtr& observation) {
  bool taken = false;
  for (auto& [section, plugin] : plugins_.pose) {
    const auto answer = plugin->add(observation);
    state_.counts.unusable += answer == PosePlugin::Taken::unusable;
    if (answer == PosePlugin::Taken::taken) state_.fed.insert(section);
    taken = taken || answer != PosePlugin::Taken::not_mine;
    const auto newest = chain_.newest();
    const auto news = plugin->news();
    if (news && newest && news->begin < *newest) chain_.relink(news->begin, news->end);
  }
  return taken;
}

// Whether every continuous source covers the time up to `stamp`. A source that has been silent for too long is not
// waited for.
bool FrontEnd::isCovered(base::Stamp stamp) const {
  const auto patience = base::durationFromSeconds(options_.window + kPatienceSeconds);
  return std::all_of(plugins_.pose.begin(), plugins_.pose.end(), [&](const auto& named) {
    const auto until = named.plugin->coveredUntil();
    return named.plugin->isFallback() || !until || *until >= stamp || *until + patience < *queue_.now();
  });
}

// Handles an observation that comes after its window. Older than the horizon, the motion of the base then is not known
// any more.
void FrontEnd::addLate(const mrpt::obs::CObservation::Ptr& observation) {
  const auto newest = chain_.newest();
  if (newest && observation->timestamp + base::durationFromSeconds(options_.horizon) < *newest) {
    ++state_.counts.too_late;
    generation_of_.erase(observation.get());
    return;
  }
  ++state_.counts.late;
  release({observation->timestamp, {observation}}, true);
}

void FrontEnd::close() {
  closed_ = true;
  schedule_.end();
}

std::optional<FrameBundle> FrontEnd::next() {
  while (!isFull() && releaseNext()) continue;
  if (bundles_.empty()) return std::nullopt;
  // What is only watched waits for nothing but its turn, so that it does not change when the other bundles are taken.
  const bool is_taken = bundles_.front().isOnlyWatched() || schedule_.takesBundle(bundles_.front(), in_perception_);
  return is_taken ? nextOfAll() : std::nullopt;
}

std::optional<FrameBundle> FrontEnd::nextOfAll() {
  if (bundles_.empty()) return std::nullopt;
  FrameBundle first = std::move(bundles_.front());
  bundles_.pop_front();
  in_perception_ -= first.isOnlyWatched() ? 0 : 1;
  return first;
}

// Releases the next group if it is due, the log has ended or the queue is full. Returns whether it released one.
bool FrontEnd::releaseNext() {
  const auto due = queue_.due();
  const bool is_ready = closed_ || (due && isCovered(*due));
  if (!is_ready) {
    if (queue_.size() <= static_cast<std::size_t>(options_.queue_limit)) return false;
    ++state_.counts.hurried;
  }
  const auto group = queue_.next();
  if (group) release(*group, false);
  return group.has_value();
}

// What all pose sources find usable of an observation; null if there is nothing.
mrpt::obs::CObservation::ConstPtr FrontEnd::usablePart(mrpt::obs::CObservation::ConstPtr observation) const {
  for (const auto& [section, plugin] : plugins_.pose) {
    if (observation) observation = plugin->usablePart(observation);
  }
  return observation;
}

// Passes a group through the trigger. Perception of the observations that fire starts at once; the bundle is processed
// after those before it.
void FrontEnd::release(const ReleaseQueue::Group& group, bool late) {
  for (auto& [section, plugin] : plugins_.pose) {
    const auto timer = state_.times.measure(Stage::plugin, section);
    plugin->processUntil(group.stamp);
  }
  const auto motion = [this](base::Stamp begin, base::Stamp end) { return chain_.motion(begin, end, false); };
  FrameBundle bundle{group.stamp, false, {}, {}};
  std::vector<mrpt::obs::CObservation::ConstPtr> fired;
  for (const auto& observation : group.observations) {
    const auto made = generation_of_.extract(observation.get());
    if (isWatched(*observation)) bundle.watched.push_back({observation, made ? made.mapped() : 0});
    // Others were queued for watchers or for a plugin that has been removed since.
    if (!only_moves_ && !perception_->wants(*observation)) continue;
    const auto usable = usablePart(observation);
    const bool fires = !usable ? false
                       : late  ? trigger_.firesLate(observation->sensorLabel, group.stamp, motion)
                               : trigger_.fires(observation->sensorLabel, group.stamp, motion);
    if (fires) {
      if (reference_sensor_.empty()) reference_sensor_ = observation->sensorLabel;
      fired.push_back(usable);
    } else {
      ++state_.counts.not_triggered;
    }
    bundle.reference = bundle.reference || observation->sensorLabel == reference_sensor_;
  }
  for (const auto& raw : fired) {
    perception::Blackboard board;
    for (const auto& [section, plugin] : plugins_.pose) plugin->share(*raw, board);
    bundle.observations.push_back(perception_->submit(raw, fired, std::move(board)));
  }
  if (bundle.isOnlyWatched() && bundle.watched.empty()) return;
  in_perception_ += bundle.isOnlyWatched() ? 0 : 1;
  bundles_.push_back(std::move(bundle));
}

std::optional<base::Stamp> FrontEnd::oldestWaiting() const {
  const auto first = std::min_element(bundles_.begin(), bundles_.end(),
                                      [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  return first == bundles_.end() ? std::nullopt : std::make_optional(first->stamp);
}

void FrontEnd::forgetBefore(base::Stamp stamp) {
  for (auto& [section, plugin] : plugins_.pose) plugin->forgetBefore(stamp);
  trigger_.forgetBefore(stamp);
}

}  // namespace omnimapper::mapper
