#pragma once

#include <omnimapper/plugin/SessionStart.h>
#include <omnimapper/plugin/View.h>

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "SignMeasurement.h"
#include "SignResection.h"
#include "SignTracks.h"
#include "Triangulation.h"

namespace omnimapper::plugins {

/// Finds a session of which nobody knows where in the map it begins, by the signs that it reads. A sign counts if what
/// it says stands on one sign of the earlier sessions alone.
class SessionBySigns {
 public:
  struct Placement {
    mapper::SessionPlace place;
    bool is_sure;  ///< several sightings agree; else it is a first guess, for searches to begin at
    std::string reason;
  };

  /// Learns what is seen at a key frame of the newest session, which may be moved (whyFixed()). `offsets`: what is
  /// known of the pan-tilt offsets of the camera. Gives where the session is once that is known, or guessed for the
  /// first time.
  std::optional<Placement> take(const std::vector<SignMeasurement>& measurements, const map::KeyFrame& frame,
                                const SignTracks& tracks, const mapper::View& view, const KnownOffsets& offsets,
                                double recent_travel);
  /// Nobody knows where the session is: no sign of the map can be told from another by its place.
  bool isLost() const { return is_lost_; }
  /// Signs have shown where it is, and nothing ties it to the map yet.
  bool isPlaced() const { return placed_at_.has_value(); }

 private:
  struct Seen {
    base::KeyFrameId frame;
    SeenKnownSign known;  // but for where the base is in the session
    double travelled;     // [m]
  };

  void learnState(const map::KeyFrame& frame, const SignTracks& tracks, const mapper::View& view, double recent_travel);
  void remember(const map::KeyFrame& frame, const SeenKnownSign& known, double travelled, double recent_travel);
  std::optional<SessionFit> fit(const mapper::View& view) const;

  bool is_known_whether_lost_ = false, is_lost_ = false, is_guessed_ = false;
  std::optional<double> placed_at_;  // [m] of the distance travelled
  std::deque<Seen> seen_;
};

}  // namespace omnimapper::plugins
