// What the engine does with a moment: its key frame, what plugins measure there, what is concluded and solved.
#include <omnimapper/mapper/SessionAlignment.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "Engine.h"
#include "run/OneSensor.h"

namespace omnimapper::mapper {

void Engine::process(Moment& moment) {
  if (moment.observations.empty()) {
    if (!chain_.hang(moment.stamp)) ++counts_.unconnected;
    return;
  }
  const BusyTimes before = busy_;
  StopWatch watch;
  const auto place = chain_.place(moment.stamp);
  if (!place) {
    counts_.unconnected += moment.observations.size();
    return;
  }
  if (moment.reference) map_.key_frames.edit(place->id).reference = true;
  const bool is_alone = place->is_new && !place->before && !place->after;
  if (is_alone) estimator_.begin();  // of its session, whose place is known to so much
  if (place->is_new && place->after) {
    ++counts_.spliced;
    for (auto& [section, plugin] : plugins_.measurement) {
      plugin->spliced(map_.keyFrame(place->id), place->before, place->after);
    }
  }
  const auto perceived = gather(moment, place->id);
  measure(place->id, perceived);
  commit(place->id);
  if (window_ && place->is_new && !place->after) noteFix(place->id);
  forget();
  const double plugins = busy_.plugins - before.plugins, solve = busy_.solve - before.solve;
  const double waited = busy_.perception + busy_.jobs - before.perception - before.jobs;
  times_.keyFrames().push_back({1e3 * plugins, 1e3 * solve, 1e3 * (watch.seconds() - plugins - solve - waited)});
}

// The raw observations, then what the pool made of them, without what the key frame has already: a perceived log
// brings derived observations of its own, and a late one may repeat an old one.
std::vector<Perceived> Engine::gather(Moment& moment, base::KeyFrameId id) {
  std::vector<Perceived> raw, derived;
  for (auto& pending : moment.observations) {
    const Timed timed(busy_.perception);
    auto [parts, errors] = pending.get();
    extraction_errors_.add(errors);
    raw.push_back(std::move(parts.front()));
    std::move(parts.begin() + 1, parts.end(), std::back_inserter(derived));
  }
  map::KeyFrame& frame = map_.key_frames.edit(id);
  std::vector<Perceived> added;
  for (auto* part : {&raw, &derived}) {
    for (auto& perceived : *part) {
      const bool is_there = std::any_of(frame.observations.begin(), frame.observations.end(), [&](const auto& other) {
        return isOfOneSensor(*other, *perceived.observation);
      });
      if (is_there) {
        counts_.repeated_stamp += part == &raw;
        continue;
      }
      frame.observations.push_back(perceived.observation);
      added.push_back(std::move(perceived));
    }
  }
  return added;
}

void Engine::measure(base::KeyFrameId id, const std::vector<Perceived>& perceived) {
  for (std::size_t i = 0; i < plugins_.measurement.size(); ++i) {
    auto& [section, plugin] = plugins_.measurement[i];
    for (const auto& one : perceived) {
      if (!plugin->wants(*one.observation)) continue;
      fed_.insert(section);
      const StopWatch watch;
      const auto& frame = map_.keyFrame(id);
      const Batch batch = plugin->measure(frame, {*one.observation, one.prepared[i].get()}, view());
      times_.add("plugin " + section, watch.seconds());
      busy_.plugins += watch.seconds();
      committer_.apply(batch, {section, frame.stamp}, *plugin);
      // Plugins that follow tell landmarks apart by this pose: it takes up what was measured of it first.
      if (plugin->givesAbsolutePoses() && batch.changesGraph()) estimator_.refine(id);
    }
  }
}

std::vector<std::string> Engine::idlePlugins() const {
  std::vector<std::string> idle;
  for (const auto& [section, plugin] : plugins_.measurement) {
    if (!plugin->worksOnLandmarks() && fed_.count(section) == 0) idle.push_back(section);
  }
  return idle;
}

std::vector<std::string> Engine::idleSources() const {
  std::vector<std::string> idle;
  for (const auto& [section, plugin] : plugins_.pose) {
    if (!plugin->measures()) continue;
    if (fed_.count(section) > 0) return {};
    idle.push_back(section);
  }
  for (const auto& [section, plugin] : plugins_.measurement) {
    if (!plugin->givesAbsolutePoses()) continue;
    if (fed_.count(section) > 0) return {};
    idle.push_back(section);
  }
  return idle;
}

void Engine::commit(base::KeyFrameId id) {
  estimator_.refine(id);
  committer_.applyJobs(false, busy_.jobs);
  if (estimator_.isDue()) solveNow(settings_.solver.running());
  committer_.collectFollowUps(id, view(), busy_.plugins);
}

// Each plugin sees what those before it concluded.
void Engine::conclude() {
  const base::Stamp now = map_.key_frames.back().stamp;
  for (auto& [section, plugin] : plugins_.measurement) {
    const StopWatch watch;
    const Batch batch = plugin->atEnd(view());
    busy_.plugins += watch.seconds();
    times_.add("plugin " + section, watch.seconds());
    if (batch.empty()) continue;
    committer_.apply(batch, {section, now}, *plugin);
    if (batch.changesGraph()) solveNow(settings_.solver.final());
  }
}

void Engine::judgeMap() {
  std::vector<Evidence> evidence;
  const auto collect = [&](const auto& plugins, const auto& evidence_of) {
    for (const auto& [section, plugin] : plugins) {
      const StopWatch watch;
      auto some = evidence_of(*plugin);
      evidence.insert(evidence.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
      busy_.plugins += watch.seconds();
      times_.add("plugin " + section, watch.seconds());
    }
  };
  collect(plugins_.pose, [](const PosePlugin& plugin) { return plugin.evidence(); });
  collect(plugins_.measurement, [this](const MeasurementPlugin& plugin) { return plugin.evidence(view()); });
  verdict_ = mapper::conclude(std::move(evidence));
}

void Engine::solveNow(const graph::SolveOptions& options) {
  const StopWatch watch;
  estimator_.solve(options);
  if (!window_) {
    markJoined(map_, graph_, absoluteOwners());
  } else if (!window_->hasRetired()) {
    markLocated(map_, graph_, absoluteOwners());
  }
  busy_.solve += watch.seconds();
  times_.add("solve", watch.seconds());
  ++counts_.solves;
  for (auto& [section, plugin] : plugins_.output) {
    const StopWatch shown;
    plugin->update(view());
    busy_.outputs += shown.seconds();
    times_.add("output " + section, shown.seconds());
  }
}

}  // namespace omnimapper::mapper
