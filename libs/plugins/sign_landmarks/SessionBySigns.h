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

/// Locates a session with an unknown start in the map by the signs that it reads. A sign is used only if exactly one
/// sign of the earlier sessions has its text.
class SessionBySigns {
 public:
  struct Placement {
    mapper::SessionPlace place;
    bool is_sure;  ///< several measurements agree; else it is a first guess, from which searches start
    std::string reason;
  };

  /// Takes the measurements at a key frame of the newest session; the session must be free to move (whyFixed()).
  /// `offsets`: the known pan-tilt offsets of the camera. Returns the place of the session when it becomes known, or
  /// when it is guessed for the first time.
  std::optional<Placement> take(const std::vector<SignMeasurement>& measurements, const map::KeyFrame& frame,
                                const SignTracks& tracks, const mapper::View& view, const KnownOffsets& offsets,
                                double recent_travel);
  /// True if the place of the session is unknown, so that positions do not show which sign of the map a measurement is
  /// of.
  bool isLost() const { return is_lost_; }
  /// True if signs have located the session, and no factor connects it to the map yet.
  bool isPlaced() const { return placed_at_.has_value(); }

 private:
  struct RecentBearing {
    base::KeyFrameId frame;
    KnownSignBearing known;  // all current except session_from_base
    double travelled;        // [m]
  };

  void learnState(const map::KeyFrame& frame, const SignTracks& tracks, const mapper::View& view, double recent_travel);
  void remember(const map::KeyFrame& frame, const KnownSignBearing& known, double travelled, double recent_travel);
  std::optional<SessionFit> fit(const mapper::View& view) const;

  bool is_known_whether_lost_ = false, is_lost_ = false, is_guessed_ = false;
  std::optional<double> placed_at_;  // [m] distance travelled when signs located the session
  std::deque<RecentBearing> seen_;
};

}  // namespace omnimapper::plugins
