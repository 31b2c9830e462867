#pragma once

#include <omnimapper/matching/ScanMatcherOptions.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/SessionSeeking.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "BrokenMotion.h"
#include "GlobalLoopSearch.h"
#include "GlobalRelocalization.h"
#include "LoopClosureOptions.h"
#include "LoopSearch.h"
#include "SessionCheck.h"
#include "SlipSearch.h"
#include "TestedClosures.h"

namespace omnimapper::plugins {

/// Closes loops with 2D scans (thesis 5.3.3.2): the newest scans are matched with the scans of places that were seen
/// long ago and that, by the covariance of the estimate, may be near. A session that no measurement ties to the saved
/// map is searched for in the whole map. Scans are matched in the plane of the base; in a spatial map a closure leaves
/// z, roll and pitch nearly unconstrained. The motion between consecutive key frames is measured by ScanOdometryPlugin.
class LoopClosurePlugin : public mapper::MeasurementPlugin,
                          public mapper::SeeksSession,
                          public mapper::ConfirmsSession {
 public:
  static constexpr const char* kName = "LoopClosurePlugin";
  static constexpr const char* kSummary = "Closes loops: the newest 2D scans are matched with places seen long ago.";

  LoopClosurePlugin(const LoopClosureOptions& options, const matching::ScanMatcherOptions& matching,
                    const mapper::PluginContext& context);

  /// True while scans arrive in a run that continues a map; without scans the plugin cannot search.
  bool isSeeking() const override;
  Says aboutSession() const override;
  bool wants(const mrpt::obs::CObservation& observation) const override;
  std::unique_ptr<const mapper::Prepared> prepare(const mrpt::obs::CObservation& observation) const override;
  mapper::Batch measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                        const mapper::View& view) override;
  void applied(const mapper::AppliedBatch& ids) override { closures_.add(ids.factors); }
  void retired(const map::KeyFrame& frame) override;
  mapper::FollowUp afterCommit(const map::KeyFrame& frame, const mapper::View& view) override;
  mapper::Batch atEnd(const mapper::View& view) override;
  /// Beams that pass through walls, places revisited without a closure, and slips (WallEvidence.h, RevisitEvidence.h,
  /// SlipEvidence.h).
  std::vector<mapper::Evidence> evidence(const mapper::View& view) const override;
  /// Loads the scans of earlier sessions, to close loops with them.
  void restore(const map::MapSection* saved, const mapper::View& view) override;

 private:
  /// The scan of one sensor at one key frame.
  struct StampedScan {
    LoopSearch::KeyScan key_scan;
    base::Stamp stamp;
    /// How well the motion from the scan before it is known (BrokenMotion.h).
    enum class Since { known, weak, broken } since = Since::known;
  };
  /// The last search in the whole saved map.
  struct LastRelocalization {
    double travel, answered;        // [m] travelled in the session: at this search, at the last answer that moved it
    mrpt::math::TPoint3D begun_at;  // start of the session as estimated at this search
  };
  /// The last global search for loops, and the database that is searched.
  struct LastGlobalSearch {
    double travel = 0, on_new_ground = 0;  // [m] travelled at this search, at the last on new ground
    std::shared_ptr<const ScanDatabase> places;
    std::size_t size = 0;             // number of scans in `places`
    std::optional<base::Stamp> tied;  // TestedClosures::newestTied() when `places` was made
    std::size_t corrections = 0;      // TestedClosures::corrections() when `places` was made
  };
  using History = std::vector<StampedScan>;  // in order of session, then stamp
  using Scan = std::shared_ptr<const matching::ScanWithNormals>;

  /// Inserts the scan into the history and returns its index.
  std::size_t remember(const map::KeyFrame& frame, const Scan& scan, const mapper::State& state, History& history);

  /// Index of the newest scan up to `index`, in its session, before which the motion is not well known.
  static std::optional<std::size_t> newestBreak(const History& history, std::size_t index,
                                                StampedScan::Since least = StampedScan::Since::weak);
  static double travelSince(std::optional<base::Stamp> stamp, const History& history, std::size_t index);
  void seekSlip(const History& history, const mapper::View& view);
  void seekGlobally(const std::string& label, const History& history, std::size_t index, const mapper::State& state);
  void watchSession(const map::KeyFrame& frame, const std::string& label, double travel, const mapper::State& state);
  mapper::Batch takenBack(const map::KeyFrame& frame, const mapper::State& state);
  void seekInMap(const std::string& label, const History& history, std::size_t index, const mapper::State& state);
  std::vector<LoopSearch::Place> loopPlaces(const map::KeyFrame& frame, const History& history, std::size_t index,
                                            const mapper::State& state) const;
  /// The scan at `centre` and the scans of the same session that are up to `before` [m] of travel before it and up to
  /// `after` [m] after it; of very many scans only a part.
  static std::vector<LoopSearch::KeyScan> keyScans(const History& history, std::size_t centre, double before,
                                                   double after);

  LoopClosureOptions options_;
  mapper::PluginContext context_;
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  std::map<std::string, History> histories_;  // by label
  std::map<std::string, double> searched_;    // [m] travelled at the last search, by label
  std::vector<LoopSearch> searches_;          // of the key frame being measured
  TestedClosures closures_;
  UsualMotion usual_motion_;
  std::size_t refused_before_ = 0;         // number of refused global closures at the last slip search
  std::vector<SlipSearch> slip_searches_;  // of the key frame being measured
  std::map<std::string, LastGlobalSearch> last_global_search_;     // by label
  std::vector<GlobalLoopSearch> global_searches_;                  // of the key frame being measured
  std::shared_ptr<const ScanDatabase> places_;                     // of the map that is continued
  int frames_without_scan_ = 0;                                    // key frames since the last scan, or since the start
  std::map<std::string, LastRelocalization> last_relocalization_;  // by label
  SessionWatch watch_;                                             // of the session that continues a map
  std::vector<GlobalRelocalization> relocalizations_;              // of the key frame being measured
};

}  // namespace omnimapper::plugins
