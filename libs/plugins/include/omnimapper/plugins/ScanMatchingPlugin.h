#pragma once

#include <omnimapper/mapper/PluginFactory.h>
#include <omnimapper/matching/ScanMatcherOptions.h>
#include <omnimapper/plugins/LoopSearch.h>
#include <omnimapper/plugins/ScanMatchingOptions.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace omnimapper::plugins {

/// 2D scan matching (thesis 5.3.3.2): each key frame's scan against the few before it, and against places seen long
/// ago to close loops. Scans are matched in the plane of the base; in a spatial map z, roll and pitch stay open.
class ScanMatchingPlugin : public mapper::MeasurementPlugin {
 public:
  ScanMatchingPlugin(const ScanMatchingOptions& options, const matching::ScanMatcherOptions& matching,
                     const mapper::PluginContext& context);

  bool wants(const mrpt::obs::CObservation& observation) const override;
  std::unique_ptr<const mapper::Prepared> prepare(const mrpt::obs::CObservation& observation) const override;
  mapper::Batch measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                        const mapper::View& view) override;
  mapper::FollowUp afterCommit(const map::KeyFrame& frame, const mapper::View& view) override;
  /// What earlier sessions saw: places to close loops with.
  void restore(const map::MapSection* saved, const mapper::View& view) override;

 private:
  /// What one sensor saw at one key frame.
  struct Seen {
    LoopSearch::Sight sight;
    base::Stamp stamp;
    double way;  // [m] driven until here
  };
  using History = std::vector<Seen>;  // in order of session, then stamp
  using Scan = std::shared_ptr<const matching::PlanarScan>;

  /// Puts it in its place and gives the index.
  std::size_t remember(const map::KeyFrame& frame, const Scan& scan, const mapper::State& state,
                       History& history) const;

  void matchSequential(const map::KeyFrame& frame, const History& history, std::size_t index,
                       const mapper::State& state, mapper::Batch& batch) const;
  std::vector<LoopSearch::Place> loopPlaces(const map::KeyFrame& frame, const History& history, std::size_t index,
                                            const mapper::State& state) const;
  /// Of that stretch, those of the session of the one at `centre`: others may lie elsewhere still.
  static std::vector<LoopSearch::Sight> sights(const History& history, std::size_t first, std::size_t end,
                                               std::size_t centre);

  ScanMatchingOptions options_;
  mapper::PluginContext context_;
  std::unique_ptr<const matching::ScanMatcher> sequential_matcher_;
  std::shared_ptr<const matching::ScanMatcher> loop_matcher_;
  std::map<std::string, History> histories_;  // by label
  std::vector<LoopSearch> searches_;          // of the key frame being measured
};

class ScanMatchingPluginFactory : public mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(ScanMatchingPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "ScanMatchingPlugin"; }
  std::string summary() const override { return "Matches 2D scans in sequence and to close loops."; }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<mapper::MeasurementPlugin> make(const base::ConfigSection& section,
                                                  const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
