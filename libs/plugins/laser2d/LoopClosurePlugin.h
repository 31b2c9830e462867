#pragma once

#include <omnimapper/matching/ScanMatcherOptions.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/SessionSeeking.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "GlobalLoopSearch.h"
#include "GlobalRelocalization.h"
#include "LoopClosureOptions.h"
#include "LoopSearch.h"
#include "SlipSearch.h"
#include "TestedClosures.h"

namespace omnimapper::plugins {

/// Closes loops with 2D scans (thesis 5.3.3.2): what was just seen is sought at places seen long ago, wherever the
/// covariance of the estimate allows them to be; a session that nothing ties to the saved map, in all of it. Scans are
/// matched in the plane of the base; in a spatial map z, roll and pitch stay open. The motion from key frame to key
/// frame is ScanOdometryPlugin's.
class LoopClosurePlugin : public mapper::MeasurementPlugin, public mapper::SeeksSession {
 public:
  LoopClosurePlugin(const LoopClosureOptions& options, const matching::ScanMatcherOptions& matching,
                    const mapper::PluginContext& context);

  /// While scans come: without them nothing is sought.
  bool isSeeking() const override;
  bool wants(const mrpt::obs::CObservation& observation) const override;
  std::unique_ptr<const mapper::Prepared> prepare(const mrpt::obs::CObservation& observation) const override;
  mapper::Batch measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                        const mapper::View& view) override;
  void applied(const mapper::AppliedBatch& ids) override { closures_.add(ids.factors); }
  void retired(const map::KeyFrame& frame) override;
  mapper::FollowUp afterCommit(const map::KeyFrame& frame, const mapper::View& view) override;
  mapper::Batch atEnd(const mapper::View& view) override;
  /// Beams that pass through walls, and places that were come back to without a closure.
  std::vector<mapper::Evidence> evidence(const mapper::View& view) const override;
  /// What earlier sessions saw: places to close loops with.
  void restore(const map::MapSection* saved, const mapper::View& view) override;

 private:
  /// What one sensor saw at one key frame.
  struct Seen {
    LoopSearch::KeyScan key_scan;
    base::Stamp stamp;
  };
  /// The last search in all of the saved map.
  struct Sought {
    double travel, answered;        // [m] of the session, then and when an answer last moved it
    mrpt::math::TPoint3D begun_at;  // where the session began, as it was then
  };
  /// The last global searches of a session for its own loops, and what they look in.
  struct SoughtGlobally {
    double travel = 0, on_new_ground = 0;  // [m]
    std::shared_ptr<const ScanDatabase> places;
    std::size_t size = 0;             // of the places
    std::optional<base::Stamp> tied;  // of TestedClosures, and its corrections, when they were gathered
    std::size_t corrections = 0;
  };
  using History = std::vector<Seen>;  // in order of session, then stamp
  using Scan = std::shared_ptr<const matching::ScanWithNormals>;

  /// Puts it in its place and gives the index.
  std::size_t remember(const map::KeyFrame& frame, const Scan& scan, const mapper::State& state, History& history);

  static double travelSince(std::optional<base::Stamp> stamp, const History& history, std::size_t index);
  void seekSlip(const History& history, const mapper::View& view);
  void seekGlobally(const std::string& label, const History& history, std::size_t index, const mapper::State& state);
  void seekInMap(const std::string& label, const History& history, std::size_t index, const mapper::State& state);
  std::vector<LoopSearch::Place> loopPlaces(const map::KeyFrame& frame, const History& history, std::size_t index,
                                            const mapper::State& state) const;
  /// What was seen in the session of the one at `centre`, so much way [m] before and after it.
  static std::vector<LoopSearch::KeyScan> keyScans(const History& history, std::size_t centre, double before,
                                                   double after);

  LoopClosureOptions options_;
  mapper::PluginContext context_;
  std::shared_ptr<const matching::ScanMatcher> matcher_;
  std::map<std::string, History> histories_;  // by label
  std::map<std::string, double> searched_;    // [m] way of the last search, by label
  std::vector<LoopSearch> searches_;          // of the key frame being measured
  TestedClosures closures_;
  std::size_t refused_before_ = 0;                         // global closures, when a slip was last sought
  std::vector<SlipSearch> slip_searches_;                  // of the key frame being measured
  std::map<std::string, SoughtGlobally> sought_globally_;  // by label
  std::vector<GlobalLoopSearch> global_searches_;          // of the key frame being measured
  std::shared_ptr<const ScanDatabase> places_;             // of a map that is continued
  int frames_without_scan_ = 0;                            // since the last scan, or the start
  std::map<std::string, Sought> sought_in_map_;            // by label
  std::vector<GlobalRelocalization> map_searches_;         // of the key frame being measured
};

class LoopClosurePluginFactory : public mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(LoopClosurePluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "LoopClosurePlugin"; }
  std::string summary() const override { return "Closes loops: 2D scans are sought at places seen long ago."; }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<mapper::MeasurementPlugin> make(const base::ConfigSection& section,
                                                  const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
