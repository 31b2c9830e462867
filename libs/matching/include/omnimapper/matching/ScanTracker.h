#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/matching/ScanMatcher.h>

#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace omnimapper::matching {

struct ScanTrackerOptions {
  int local_scans = 40;                                              ///< that make the local map
  double local_distance = 0.25;                                      ///< [m] between them
  double local_angle = 10.0 * base::option_text::kRadiansPerDegree;  ///< [rad] between them
  double min_overlap = 0.5;                                          ///< share of the points that must find a partner
  double max_correction = 0.5;                                       ///< [m] of a guess by the match
  double max_turn_correction = 20 * base::option_text::kRadiansPerDegree;  ///< [rad]

  static const base::OptionTable<ScanTrackerOptions>& table();
};

/// Follows a laser from scan to scan: each is matched against a local map of some before it, so that what one scan errs
/// the next does not carry on. Poses are of the frame that the scans are in.
class ScanTracker {
 public:
  ScanTracker(const ScanTrackerOptions& options, std::shared_ptr<const ScanMatcher> matcher)
      : options_(options), matcher_(std::move(matcher)) {}

  /// Forgets all scans; this one is the first.
  void restart(const PlanarScan& scan);
  struct Tracked {
    ScanMatch match;    ///< of the motion since the last scan; covariance and all are of the scan in the local map
    std::size_t guess;  ///< that led to it
  };
  /// Matches a scan and takes it for the last one. `guesses`: of the motion since the last scan, that most trusted
  /// first; the next is tried where one does not lead to a match. None, and nothing changes, if none does.
  std::optional<Tracked> track(const PlanarScan& scan, const std::vector<MatchGuess>& guesses);

 private:
  struct Local {
    mrpt::math::TPose2D track_from_scan;
    PlanarScan scan;
  };
  void remember(const PlanarScan& scan);

  ScanTrackerOptions options_;
  std::shared_ptr<const ScanMatcher> matcher_;
  std::deque<Local> locals_;
  std::shared_ptr<const MatchReference> reference_;  // of locals_, in the frame of the newest of them
  mrpt::math::TPose2D track_from_last_;
};

}  // namespace omnimapper::matching
