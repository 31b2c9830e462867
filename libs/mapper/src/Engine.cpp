#include "Engine.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Stamp.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <new>
#include <optional>
#include <utility>

namespace omnimapper::mapper {

Engine::Engine(const EngineSettings& settings, const std::string& title, SensorPoses sensor_poses, PluginSet plugins,
               int threads, std::unique_ptr<Schedule> schedule)
    : settings_(settings),
      plugins_(std::move(plugins)),
      schedule_(std::move(schedule)),
      back_end_(settings_, plugins_, pool_, *schedule_, state_),
      front_end_(settings_, std::move(sensor_poses), plugins_, back_end_.chain(), pool_, *schedule_, state_),
      sessions_(settings_.session, title, back_end_, state_),
      pool_(std::max(1, threads)) {
  if (plugins_.pose.empty()) {
    throw base::Error(
        base::ExitCode::unknown_plugin,
        "[mapper] names no pose_plugins: a map needs at least one; see --list-plugins. An INI of extractors "
        "alone, such as objects.ini, is for omnimapper-perceive");
  }
}

void Engine::add(const mrpt::obs::CObservation::Ptr& observation) {
  const auto timer = state_.times.measure(Stage::engine);
  front_end_.add({observation});
  while (auto bundle = front_end_.next()) process(*bundle);
}

void Engine::poll() {
  const auto timer = state_.times.measure(Stage::engine);
  while (auto bundle = front_end_.next()) process(*bundle);
}

void Engine::process(FrameBundle& bundle) {
  const auto begin = state_.times.mark();
  if (back_end_.process(bundle)) {
    schedule_->mapped(bundle.stamp);
    forget();
    state_.times.addKeyFrameSince(begin);
  }
  if (!bundle.watched.empty()) takeAnswers(bundle);
}

// Answers to answers end after some generations, so that two plugins cannot keep the engine busy with each other.
void Engine::takeAnswers(const FrameBundle& bundle) {
  constexpr int kMostGenerations = 8;
  for (const auto& answer : back_end_.watch(bundle)) {
    if (answer.generation <= kMostGenerations) {
      front_end_.add(answer);
    } else {
      const std::string sentence = "a plugin answers the observations '" + answer.observation->sensorLabel +
                                   "' of plugins without end; its further answers are left out";
      if (std::count(state_.warnings.begin(), state_.warnings.end(), sentence) == 0) warn(sentence);
    }
  }
}

// Drops the data that no late observation can need any more: neither one that still waits, nor one that comes within
// the horizon.
void Engine::forget() {
  PoseChain& chain = back_end_.chain();
  const base::Stamp horizon = *chain.newest() - base::durationFromSeconds(settings_.engine.horizon);
  const auto kept = chain.lastAtOrBefore(std::min(horizon, front_end_.oldestWaiting().value_or(horizon)));
  if (!kept) return;
  front_end_.forgetBefore(*kept);
  back_end_.retireBefore(*kept);
}

namespace {

bool isRemoved(const PluginChange& change, const std::string& section) {
  return std::count(change.removed.begin(), change.removed.end(), section) > 0;
}

// Replaces the removed plugins of a kind by the added ones.
template <class Plugin>
void exchange(std::vector<Named<Plugin>>& plugins, std::vector<Named<Plugin>>& added, const PluginChange& change,
              const std::vector<std::string>& order) {
  const auto is_removed = [&](const auto& named) { return isRemoved(change, named.section); };
  plugins.erase(std::remove_if(plugins.begin(), plugins.end(), is_removed), plugins.end());
  std::move(added.begin(), added.end(), std::back_inserter(plugins));
  const auto rank = [&](const auto& named) { return std::find(order.begin(), order.end(), named.section); };
  std::stable_sort(plugins.begin(), plugins.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
}

}  // namespace

std::string Engine::changePlugins(PluginChange change) {
  const auto timer = state_.times.measure(Stage::engine);
  drain();
  back_end_.savePlugins();
  if (change.layers) back_end_.readLayersAgain(*change.layers);
  const std::string problem = whyNotChanged(change);
  if (problem.empty()) exchangePlugins(change);
  return problem;
}

// Finishes everything in perception and every job. A bundle may not become part of the map, and its perception, which
// uses the plugins, still runs then.
void Engine::drain() {
  schedule_->setDraining(true);
  while (auto bundle = front_end_.nextOfAll()) {
    for (const auto& made : bundle->observations) made.wait();
    process(*bundle);
  }
  while (back_end_.hasJobs()) back_end_.applyAllJobs();
  schedule_->setDraining(false);
}

std::string Engine::whyNotChanged(const PluginChange& change) {
  const auto stays = [&](const auto& named) { return !isRemoved(change, named.section); };
  if (!state_.map.key_frames.empty() && std::none_of(plugins_.pose.begin(), plugins_.pose.end(), stays)) {
    return "no pose plugin would stay as it is, and a new one does not know how the base moved since the last key "
           "frame";
  }
  for (const auto& [section, plugin] : change.added.measurement) {
    try {
      if (!state_.map.key_frames.empty()) back_end_.restore(section, *plugin);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      return "[" + section + "] cannot go on in this map: " + error.what();
    }
  }
  return "";
}

void Engine::exchangePlugins(PluginChange& change) {
  const auto keep = [&](const auto& plugins) {
    for (const auto& [section, plugin] : plugins)
      if (isRemoved(change, section))
        for (const auto& sentence : plugin->warnings()) warn("[" + section + "] " + sentence);
  };
  keep(plugins_.pose);
  keep(plugins_.extractors);
  keep(plugins_.measurement);
  back_end_.evidence().keep([&](const std::string& section) { return isRemoved(change, section); });
  exchange(plugins_.pose, change.added.pose, change, change.order.pose);
  exchange(plugins_.extractors, change.added.extractors, change, change.order.extractors);
  exchange(plugins_.measurement, change.added.measurement, change, change.order.measurement);
  exchange(plugins_.output, change.added.output, change, change.order.output);
  front_end_.pluginsChanged();
  back_end_.pluginsChanged();
}

void Engine::finish() {
  const auto timer = state_.times.measure(Stage::engine);
  // If one plugin throws, the map of the others is still finished; the exception is rethrown at the end.
  std::exception_ptr failed;
  const auto tried = [&failed](const auto& work) {
    try {
      work();
    } catch (...) {
      if (!failed) failed = std::current_exception();
    }
  };
  front_end_.close();
  for (bool is_more = true; is_more;) {
    tried([&] {
      auto bundle = front_end_.next();
      is_more = bundle.has_value();
      if (bundle) process(*bundle);
    });
  }
  while (back_end_.hasJobs()) tried([&] { back_end_.applyAllJobs(); });
  if (!state_.map.key_frames.empty()) {
    tried([&] { back_end_.solveFinally(); });
    tried([&] { back_end_.conclude(shared_); });
  }
  tried([&] { back_end_.savePlugins(); });
  if (!state_.map_is_held) tried([&] { back_end_.evidence().judge(); });
  if (state_.extraction_errors.count() > 0) warn(state_.extraction_errors.sentence());
  if (failed) std::rethrow_exception(failed);
}

void Engine::judge() {
  const auto timer = state_.times.measure(Stage::engine);
  if (!state_.map_is_held && !state_.map.key_frames.empty()) back_end_.evidence().judge();
}

void Engine::note(const std::string& what) {
  Decision decision;
  decision.plugin = "engine";
  decision.kind = "change of the run";
  decision.accepted = true;
  decision.reason = what;
  if (!state_.map.key_frames.empty()) {
    decision.stamp = state_.map.key_frames.back().stamp;
    decision.from = state_.map.key_frames.back().id;
  }
  state_.decisions.push_back(std::move(decision));
}

std::vector<std::string> Engine::idlePlugins() const {
  std::vector<std::string> idle;
  for (const auto& [section, plugin] : plugins_.measurement) {
    if (!plugin->worksOnLandmarks() && state_.fed.count(section) == 0) idle.push_back(section);
  }
  return idle;
}

std::vector<std::string> Engine::idleSources() const {
  std::vector<std::string> idle;
  for (const auto& [section, plugin] : plugins_.pose) {
    if (!plugin->measures()) continue;
    if (state_.fed.count(section) > 0) return {};
    idle.push_back(section);
  }
  for (const auto& [section, plugin] : plugins_.measurement) {
    if (!plugin->givesAbsolutePoses()) continue;
    if (state_.fed.count(section) > 0) return {};
    idle.push_back(section);
  }
  return idle;
}

std::vector<base::Error> Engine::writeOutputs() {
  std::vector<base::Error> failures;
  View finished = view();
  finished.shared = &shared_;
  for (auto& [section, plugin] : plugins_.output) {
    if (state_.map_is_held && plugin->isOfMap()) continue;
    const auto timer = state_.times.measure(Stage::output, section);
    try {
      plugin->finish(finished);
    } catch (const base::Error& error) {
      failures.push_back(error);
    } catch (const std::bad_alloc&) {
      failures.emplace_back(
          base::ExitCode::out_of_memory,
          "[" + section + "] ran out of memory; give the program more memory, or leave out this output");
    } catch (const std::exception& error) {  // a defect of one output must not cost the others
      failures.emplace_back(base::ExitCode::internal, "[" + section + "]: " + error.what());
    }
  }
  shared_ = {};
  return failures;
}

bool Engine::isLookedAt() const {
  return std::any_of(plugins_.output.begin(), plugins_.output.end(),
                     [](const auto& named) { return named.plugin->isLookedAt(); });
}

}  // namespace omnimapper::mapper
