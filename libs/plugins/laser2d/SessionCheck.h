#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "ScanDatabase.h"

namespace omnimapper::plugins {

/// How the scans of a session fit the saved map at a place that was found for the session.
struct SessionCheck {
  bool is_possible = true;         ///< false if the map is too large for the grids that are needed; it is then believed
  double fitting = 0;              ///< [m] of travel from the first to the last scan that fits
  std::size_t scans = 0;           ///< number of scans that were compared
  std::size_t fits = 0;            ///< number of those that fit
  std::size_t contradicting = 0;   ///< number of those that contradict the map there
  double contradicting_beams = 0;  ///< mean share of the beams of the scans that fit, which contradict the map there

  /// Whether scans from two places fit, or from one if the place `agrees_with_start`, where the session was said to
  /// begin; and hardly any contradicts the map.
  bool confirms(bool agrees_with_start) const;
};

/// Compares scans along the travel of a session, the newest last, with the map, given the pose of the newest.
SessionCheck checkSession(const ScanDatabase& places, const std::string& label,
                          const std::vector<LoopSearch::KeyScan>& newest, const mrpt::math::TPose2D& map_from_newest,
                          const mapper::State& state);

/// Watches whether the scans of a session that is tied to the saved map keep fitting it.
class SessionWatch {
 public:
  /// `map_is_held`: the session is localized in a map that does not change. A map that is continued bends: there a
  /// contradiction must be larger.
  explicit SessionWatch(bool map_is_held) : map_is_held_(map_is_held) {}

  /// Takes the scan of a key frame at its estimated pose. `travel`: distance travelled in the session [m].
  void add(const ScanDatabase& places, const std::string& label, const map::KeyFrame& frame, double travel,
           const mapper::State& state);
  /// Whether most of the latest scans contradict the map.
  bool isContradicted() const;
  /// Whether a scan within the last metres travelled fits the map, and the latest do not contradict it.
  bool isConfirmed() const;
  /// Begins again: the session is not tied to the map yet, or no longer. Once it is, what tied it confirms it at first.
  void reset(double travel) {
    latest_.clear();
    travel_ = confirmed_ = travel;
  }
  double travel() const { return travel_; }  ///< [m] at the last key frame

 private:
  struct Scan {
    double travel;  // [m]
    bool fits, contradicts;
  };
  bool map_is_held_;
  std::deque<Scan> latest_;
  double travel_ = 0, confirmed_ = 0;  // [m] of the last key frame, of the last scan that fits
};

}  // namespace omnimapper::plugins
