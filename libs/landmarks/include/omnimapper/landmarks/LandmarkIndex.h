#pragma once

#include <omnimapper/plugin/View.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace omnimapper::landmarks {

/// What a plugin keeps of one of its landmarks beside map and graph. A type that keeps more derives from this, and
/// hides refresh() by its own, which calls this one.
struct KnownLandmark {
  base::LandmarkId id;
  base::VariableId variable;  ///< its only variable; valid after the first refresh()

  /// Takes over what has changed in the map.
  void refresh(const map::Landmark& landmark, const mapper::View& /*view*/) { variable = landmark.variables.front(); }
};

/// The landmarks of one plugin with which measurements may be associated, by id. The map owns the landmarks; this index
/// follows it.
template <class Known = KnownLandmark>
class LandmarkIndex {
 public:
  /// `owner`: INI section of the plugin.
  explicit LandmarkIndex(std::string owner) : owner_(std::move(owner)) {}

  const std::string& owner() const { return owner_; }
  /// Adds the landmarks that the plugin has in a map that is continued, or in which a run localizes.
  void restore(const mapper::View& view) {
    for (const auto id : view.candidates(owner_)) add(id);
  }
  void add(base::LandmarkId id) { known_[id].id = id; }
  /// Drops landmarks that were retired, or merged into others, and refreshes those that are left.
  void update(const mapper::View& view) {
    for (auto at = known_.begin(); at != known_.end();) {
      const map::Landmark* landmark = view.map.landmarks.find(at->first);
      if (!landmark || landmark->state != map::Landmark::State::active) {
        at = known_.erase(at);
        continue;
      }
      at->second.refresh(*landmark, view);
      ++at;
    }
  }

  const std::map<base::LandmarkId, Known>& all() const { return known_; }
  Known& at(base::LandmarkId id) { return known_.at(id); }
  const Known& at(base::LandmarkId id) const { return known_.at(id); }
  /// The newest landmark for which `is(known)` holds; null if there is none.
  template <class Is>
  const Known* newest(const Is& is) const {
    const auto found = std::find_if(known_.rbegin(), known_.rend(), [&](const auto& each) { return is(each.second); });
    return found == known_.rend() ? nullptr : &found->second;
  }

 private:
  std::string owner_;
  std::map<base::LandmarkId, Known> known_;
};

}  // namespace omnimapper::landmarks
