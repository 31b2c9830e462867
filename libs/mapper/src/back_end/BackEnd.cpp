#include "back_end/BackEnd.h"

#include <omnimapper/derived/SessionAlignment.h>
#include <omnimapper/plugin/SessionSeeking.h>
#include <omnimapper/plugin/WatchesObservations.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "OneSensor.h"

namespace omnimapper::mapper {

namespace {

std::set<std::string> absoluteSections(const PluginSet& plugins) {
  std::set<std::string> sections;
  for (const auto& [section, plugin] : plugins.measurement) {
    if (plugin->givesAbsolutePoses()) sections.insert(section);
  }
  return sections;
}

RawImages imagesThatOutputsNeed(const PluginSet& plugins) {
  RawImages most = RawImages::none;
  for (const auto& [section, plugin] : plugins.output) most = std::max(most, plugin->needsOfImages());
  return most;
}

// While a plugin searches for the session, plugins whose landmarks look alike must not tie it to the map first.
void updateSeeking(const PluginSet& plugins, const map::Map& map) {
  const auto is_seeking = [](const auto& named) {
    const auto* seeker = dynamic_cast<const SeeksSession*>(named.plugin.get());
    return seeker && seeker->isSeeking();
  };
  const bool any_seeks =
      !map.sessions.back().aligned && std::any_of(plugins.measurement.begin(), plugins.measurement.end(), is_seeking);
  for (const auto& [section, plugin] : plugins.measurement) {
    if (auto* other = dynamic_cast<LeavesSeeking*>(plugin.get())) other->leaveSeeking(any_seeks);
  }
}

}  // namespace

BackEnd::BackEnd(const EngineSettings& settings, PluginSet& plugins, base::WorkerPool& pool, Schedule& schedule,
                 RunState& state)
    : settings_(settings),
      plugins_(plugins),
      state_(state),
      absolute_(absoluteSections(plugins)),
      chain_(settings.engine.motion, plugins.pose, state.map, state.graph),
      estimator_(settings, state),
      applier_(plugins.measurement, state, estimator_, pool, schedule,
               static_cast<std::size_t>(settings.engine.job_delay)),
      kept_(settings.engine.cloud(), imagesThatOutputsNeed(plugins), state.map),
      evidence_(settings.engine.motion, plugins, state) {}

void BackEnd::beginSession(const map::Session& session, const std::optional<SessionStart>& start) {
  chain_.beginSession(session, start, !absolute_.empty());
}

bool BackEnd::process(FrameBundle& bundle) {
  if (bundle.observations.empty()) {
    if (!bundle.reference) return false;  // it is only watched
    if (!chain_.attach(bundle.stamp)) {
      ++state_.counts.unconnected;
      return false;
    }
    for (auto& [section, plugin] : plugins_.output) plugin->frameAdded(state_.view());
    return false;
  }
  const auto place = chain_.place(bundle.stamp);
  if (!place) {
    state_.counts.unconnected += bundle.observations.size();
    return false;
  }
  if (bundle.reference) state_.map.key_frames.edit(place->id).reference = true;
  const bool is_first = place->is_new && !place->before && !place->after;
  // The gates start from the covariance of the prior on the first key frame of the session.
  if (is_first) estimator_.begin();
  if (place->is_new && place->after) ++state_.counts.spliced;
  const auto gathered = gather(bundle, place->id);
  measure(place->id, gathered.perceived);
  commit(place->id);
  if (!window_) kept_.addCloud(place->id, gathered.cloud);
  kept_.dropImages(place->id);
  if (window_ && place->is_new && !place->after) addEstimate(place->id);
  for (auto& [section, plugin] : plugins_.output) plugin->keyFrameAdded(state_.view());
  return true;
}

std::vector<Arrival> BackEnd::watch(const FrameBundle& bundle) {
  std::vector<Arrival> made;
  for (const auto& [observation, generation] : bundle.watched) {
    for (auto& [section, plugin] : plugins_.measurement) {
      auto* watcher = dynamic_cast<WatchesObservations*>(plugin.get());
      if (!watcher || !watcher->watches(*observation)) continue;
      state_.fed.insert(section);
      const auto watched = [&, &section = section, &observation = observation] {
        const auto timer = state_.times.measure(Stage::plugin, section);
        return watcher->watch({*observation, chain_.at(bundle.stamp)}, state_.view());
      };
      const auto result = watched();
      if (!result.batch.empty()) applier_.apply(result.batch, {section, bundle.stamp}, *plugin);
      for (const auto& answer : result.observations) made.push_back({answer, generation + 1});
    }
  }
  return made;
}

// Collects the raw observations, then the derived ones. Observations that the key frame already has are left out: a
// perceived log contains derived observations, and a late observation may repeat an old one.
BackEnd::Gathered BackEnd::gather(FrameBundle& bundle, base::KeyFrameId id) {
  std::vector<Perceived> raw, derived;
  std::vector<map::CloudPoint> cloud;
  for (auto& pending : bundle.observations) {
    const auto timer = state_.times.measure(Stage::perception_wait);
    auto made = pending.get();
    state_.extraction_errors.add(made.errors);
    raw.push_back(std::move(made.parts.front()));
    std::move(made.parts.begin() + 1, made.parts.end(), std::back_inserter(derived));
    cloud.insert(cloud.end(), made.cloud.begin(), made.cloud.end());
  }
  map::KeyFrame& frame = state_.map.key_frames.edit(id);
  std::vector<Perceived> added;
  for (auto* part : {&raw, &derived}) {
    for (auto& perceived : *part) {
      const bool is_there = std::any_of(frame.observations.begin(), frame.observations.end(), [&](const auto& other) {
        return isOfOneSensor(*other, *perceived.observation);
      });
      if (is_there) {
        state_.counts.repeated_stamp += part == &raw;
        continue;
      }
      frame.observations.push_back(perceived.observation);
      added.push_back(std::move(perceived));
    }
  }
  return {std::move(added), std::move(cloud)};
}

void BackEnd::measure(base::KeyFrameId id, const std::vector<Perceived>& perceived) {
  updateSeeking(plugins_, state_.map);
  for (std::size_t i = 0; i < plugins_.measurement.size(); ++i) {
    auto& [section, plugin] = plugins_.measurement[i];
    for (const auto& one : perceived) {
      if (!plugin->wants(*one.observation)) continue;
      state_.fed.insert(section);
      const auto& frame = state_.map.keyFrame(id);
      const auto measured = [&, &section = section, &plugin = plugin] {
        const auto timer = state_.times.measure(Stage::plugin, section);
        return plugin->measure(frame, {*one.observation, one.prepared[i].get()}, state_.view());
      };
      const Batch batch = measured();
      applier_.apply(batch, {section, frame.stamp}, *plugin);
      // The plugins that follow associate landmarks from this pose, so it is first refined with the new measurement.
      if (plugin->givesAbsolutePoses() && batch.changesGraph()) estimator_.refine(id);
    }
  }
}

void BackEnd::commit(base::KeyFrameId id) {
  estimator_.refine(id);
  applier_.applyJobs(BatchApplier::Which::due);
  if (estimator_.isDue()) {
    solve(&Estimator::solve);
  } else {
    const auto timer = state_.times.measure(Stage::solve);
    estimator_.follow();
  }
  applier_.collectFollowUps(id);
}

void BackEnd::applyAllJobs() {
  applier_.applyJobs(BatchApplier::Which::all);
}

void BackEnd::solve(void (Estimator::*how)()) {
  {
    const auto timer = state_.times.measure(Stage::solve);
    (estimator_.*how)();
    if (!window_) {
      derived::markAligned(state_.map, state_.graph, absolute_);
    } else if (!window_->hasRetired()) {
      derived::markLocated(state_.map, state_.graph, absolute_);
    }
  }
  kept_.posesChanged();
  ++state_.counts.solves;
  for (auto& [section, plugin] : plugins_.output) {
    const auto timer = state_.times.measure(Stage::output, section);
    plugin->update(state_.view());
  }
}

// Each plugin sees the results of those before it.
void BackEnd::conclude(SharedResults& shared) {
  const base::Stamp now = state_.map.key_frames.back().stamp;
  for (auto& named : plugins_.measurement) {
    const auto concluded = [&] {
      const auto timer = state_.times.measure(Stage::plugin, named.section);
      View finished = state_.view();
      finished.shared = &shared;
      return named.plugin->atEnd(finished);
    };
    const Batch batch = concluded();
    if (batch.empty()) continue;
    applier_.apply(batch, {named.section, now}, *named.plugin);
    if (batch.changesGraph() || batch.changesLandmarks()) shared = {};
    if (batch.changesGraph()) solveFinally();
  }
}

void BackEnd::resume() {
  estimator_.resume();
  kept_.posesChanged();
  for (auto& [section, plugin] : plugins_.measurement) restore(section, *plugin);
}

void BackEnd::restore(const std::string& section, MeasurementPlugin& plugin) {
  const std::string name = kPluginLayerPrefix + section;
  const auto layer = state_.map.layers.find(name);
  std::optional<map::MapSection> saved;
  if (layer) saved = map::layerToSection(name, *layer);
  plugin.restore(saved ? &*saved : nullptr, state_.view());
}

void BackEnd::pluginsChanged() {
  absolute_ = absoluteSections(plugins_);
  kept_.keepAtLeast(imagesThatOutputsNeed(plugins_));
}

void BackEnd::readLayersAgain(const map::LayerRegistry& readers) {
  for (const auto& [name, layer] : map::Layers(state_.map.layers)) {
    if (!dynamic_cast<const map::RawLayer*>(layer.get())) continue;
    try {
      state_.map.layers.set(name, readers.read(map::layerToSection(name, *layer)));
    } catch (const base::Error& error) {
      state_.warnings.push_back("the layer \"" + name + "\" of the map cannot be read: " + error.what());
    }
  }
}

// The states of these plugins replace those that they saved before; all other layers are kept.
void BackEnd::savePlugins() {
  for (auto& [section, plugin] : plugins_.measurement) {
    auto saved = plugin->save();
    if (!saved) continue;
    state_.map.layers.set(kPluginLayerPrefix + section,
                          std::make_shared<const map::RawLayer>(saved->version, std::move(saved->bytes)));
  }
}

void BackEnd::holdMap(int key_frames) {
  // A job may return factors of its key frame, which must then still be free.
  const int free = std::max(key_frames, settings_.engine.job_delay + 1);
  window_.emplace(settings_.engine.motion, static_cast<std::size_t>(free), state_.map, state_.graph);
  window_->holdMap();
  estimator_.hold(window_->held());
  state_.map_is_held = true;
}

void BackEnd::retireBefore(base::Stamp stamp) {
  if (!window_) return;
  for (const auto id : window_->retire(stamp)) {
    chain_.retire(id);
    for (auto& [section, plugin] : plugins_.measurement) plugin->retired(state_.map.keyFrame(id));
  }
  estimator_.hold(window_->held());
}

// A session counts as located only while some plugin confirms it, if any plugin can, and none contradicts it. Measured
// absolute poses need no confirmation.
bool BackEnd::isConfirmed() const {
  using Says = ConfirmsSession::Says;
  bool can_confirm = false, is_confirmed = false;
  for (const auto& [section, plugin] : plugins_.measurement) {
    const auto* confirming = dynamic_cast<const ConfirmsSession*>(plugin.get());
    if (!confirming || state_.fed.count(section) == 0) continue;
    const Says says = confirming->aboutSession();
    if (says == Says::contradicted) return false;
    can_confirm = can_confirm || says != Says::unable;
    is_confirmed = is_confirmed || says == Says::confirmed;
  }
  const bool is_absolute = std::any_of(absolute_.begin(), absolute_.end(),
                                       [&](const auto& section) { return state_.fed.count(section) > 0; });
  return is_confirmed || !can_confirm || is_absolute;
}

void BackEnd::addEstimate(base::KeyFrameId id) {
  const auto& frame = state_.map.keyFrame(id);
  const auto covariance = state_.view().covarianceBetween(state_.map.key_frames.front().id, id);
  state_.localization.push_back(
      {id, frame.stamp, frame.map_from_base, covariance, state_.map.sessions.back().aligned && isConfirmed()});
}

}  // namespace omnimapper::mapper
