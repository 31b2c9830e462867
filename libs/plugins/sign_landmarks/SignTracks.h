#pragma once

#include <omnimapper/plugin/View.h>

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "SignMeasurement.h"
#include "SignPayload.h"
#include "Triangulation.h"

namespace omnimapper::plugins {

const SignPayload& signOf(const mapper::State& state, base::LandmarkId id);

/// The signs of the map, how long ago each was seen, and sightings that wait until they show where a sign is.
class SignTracks {
 public:
  /// `owner`: INI section.
  explicit SignTracks(std::string owner) : owner_(std::move(owner)) {}

  void restore(const mapper::State& state);
  /// Learns what the map has now, and that the base came to this key frame.
  void goTo(const map::KeyFrame& frame, const mapper::State& state, double recent_travel);
  /// Forgets what was retired or merged.
  void update(const mapper::State& state);
  void add(base::LandmarkId id);
  void seen(base::LandmarkId id) { known_.at(id).last_seen = way_; }

  struct Known {
    base::VariableId variable;
    std::optional<double> last_seen;  ///< [m] of the way; none in this session
  };
  double travelled() const { return way_; }
  const std::map<base::LandmarkId, Known>& known() const { return known_; }
  bool isRecent(const Known& known, double recent_travel) const {
    return known.last_seen && way_ - *known.last_seen <= recent_travel;
  }

  /// The views of one sign that waits, not older than `recent_travel`, with this one.
  std::vector<SignView>& waitingWith(const SignView& view, double recent_travel);
  /// Removes the views with these ascending indices from those that waitingWith() gave last.
  void forget(const std::vector<std::size_t>& which);

  /// Views of which no sign was made, those of one text and one stretch of the way together.
  std::vector<std::vector<SignView>> unplacedViews(double recent_travel) const;

  std::vector<base::LandmarkId> fresh;  ///< landmarks that nobody has compared with the others yet

 private:
  struct Waiting {
    std::vector<SignView> views;
    double last_seen;
  };

  void keepForTheEnd(const SignView& view);

  std::string owner_;
  std::map<base::LandmarkId, Known> known_;
  std::deque<Waiting> waiting_;    // that which was seen last is last
  std::deque<SignView> unplaced_;  // views that waited too long
  double way_ = 0;                 // [m] that the base has gone
  std::optional<base::VariableId> last_pose_;
  base::Stamp last_stamp_;
};

}  // namespace omnimapper::plugins
