// What the engine does with a map that was there before: taking it up, localizing in it, leaving it to the next
// session.
#include <algorithm>
#include <utility>

#include "Engine.h"

namespace omnimapper::mapper {

void Engine::continueFrom(SavedMap saved, const SessionStart& start) {
  takeUp(std::move(saved), start);
  restorePlugins();
}

void Engine::localizeIn(SavedMap saved, const SessionStart& start, int key_frames) {
  takeUp(std::move(saved), start);
  restorePlugins();
  // What a job finds of a key frame must find it free.
  const int free = std::max(key_frames, settings_.engine.job_delay + 1);
  window_.emplace(settings_.engine.motion, static_cast<std::size_t>(free), map_, graph_);
  window_->holdMap();
  estimator_.hold(window_->held());
}

void Engine::takeUp(SavedMap saved, const SessionStart& start) {
  map::Session session = map_.sessions.back();
  map_ = std::move(saved.map);
  graph_ = std::move(saved.graph);
  sections_ = std::move(saved.sections);
  session.number = static_cast<std::uint16_t>(map_.sessions.empty() ? 0 : map_.sessions.back().number + 1);
  session.joined = false;
  graph_.setSession(session.number);
  estimator_.takeUp();
  chain_.beginSession(session, start, !absoluteOwners().empty());
}

void Engine::restorePlugins() {
  for (auto& [section, plugin] : plugins_.measurement) {
    const auto found = std::find_if(sections_.begin(), sections_.end(), [&name = section](const auto& other) {
      return other.name == kPluginSectionPrefix + name;
    });
    plugin->restore(found == sections_.end() ? nullptr : &*found, view());
  }
}

void Engine::retire(base::Stamp stamp) {
  const auto retired = window_->retire(stamp);
  for (const auto id : retired) {
    chain_.retire(id);
    for (auto& [section, plugin] : plugins_.measurement) plugin->retired(map_.keyFrame(id));
  }
  estimator_.hold(window_->held());
}

void Engine::noteFix(base::KeyFrameId id) {
  const auto& frame = map_.keyFrame(id);
  const auto covariance = view().covarianceBetween(map_.key_frames.front().id, id);
  fixes_.push_back({id, frame.stamp, frame.map_from_base, covariance, map_.sessions.back().joined});
}

// What plugins keep for a later session takes the place of what they kept before; sections of nobody here stay.
void Engine::collectSections() {
  for (auto& [section, plugin] : plugins_.measurement) {
    auto saved = plugin->save();
    if (!saved) continue;
    saved->name = kPluginSectionPrefix + section;
    const auto place =
        std::find_if(sections_.begin(), sections_.end(), [&](const auto& other) { return other.name == saved->name; });
    if (place == sections_.end()) {
      sections_.push_back(std::move(*saved));
    } else {
      *place = std::move(*saved);
    }
  }
}

// Sections of the plugins that say where in the map the base is.
std::set<std::string> Engine::absoluteOwners() const {
  std::set<std::string> owners;
  for (const auto& [section, plugin] : plugins_.measurement) {
    if (plugin->givesAbsolutePoses()) owners.insert(section);
  }
  return owners;
}

}  // namespace omnimapper::mapper
