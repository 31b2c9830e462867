#pragma once

#include <omnimapper/landmarks/LandmarkIndex.h>

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "SignMeasurement.h"
#include "SignPayload.h"
#include "Triangulation.h"

namespace omnimapper::plugins {

const SignPayload& signOf(const mapper::State& state, base::LandmarkId id);

/// A sign of the map.
struct KnownSign : landmarks::KnownLandmark {
  std::optional<double> last_seen;  ///< [m] distance travelled then; none if the sign was not seen in this session
};

/// The signs of the map, how long ago each was seen, and measurements that wait until they determine a sign's position.
class SignTracks : public landmarks::LandmarkIndex<KnownSign> {
 public:
  using LandmarkIndex::LandmarkIndex;

  /// Adds the distance that the base travelled to this key frame.
  void goTo(const map::KeyFrame& frame, const mapper::State& state, double recent_travel);
  /// Adds a sign that is new in this session.
  void add(base::LandmarkId id);
  void seen(base::LandmarkId id) { at(id).last_seen = travelled_; }

  double travelled() const { return travelled_; }
  bool isRecent(const KnownSign& known, double recent_travel) const {
    return known.last_seen && travelled_ - *known.last_seen <= recent_travel;
  }

  /// Adds a view to the waiting views with the same text, and returns those that are not older than `recent_travel` [m]
  /// of travel.
  std::vector<SignView>& waitingWith(const SignView& view, double recent_travel);
  /// Removes the views with these indices, in ascending order, from those that waitingWith() returned last.
  void forget(const std::vector<std::size_t>& which);

  /// Views from which no sign was made, grouped by text and by stretches of the distance travelled.
  std::vector<std::vector<SignView>> unplacedViews(double recent_travel) const;

  std::vector<base::LandmarkId> fresh;  ///< landmarks that were not compared with the others yet

 private:
  struct Waiting {
    std::vector<SignView> views;
    double last_seen;
  };

  void keepForTheEnd(const SignView& view);

  std::deque<Waiting> waiting_;    // in the order in which they were last seen
  std::deque<SignView> unplaced_;  // views that waited too long
  double travelled_ = 0;           // [m] distance travelled by the base
  std::optional<base::VariableId> last_pose_;
  base::Stamp last_stamp_;
};

}  // namespace omnimapper::plugins
