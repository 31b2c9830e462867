#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct DynamicLandmarksOptions {
  std::vector<std::string> landmarks;  ///< INI sections whose landmarks are examined; empty: all
  int every_solves = 0;                ///< number of solves between two searches; 0: only at the end
  double max_weight = 0.8;             ///< landmarks with a smaller weight are examined
  int min_measurements = 2;            ///< at one place; fewer count as errors
  double min_move = 0.15;              ///< [m] smallest displacement that counts as moved
  double visit_gap = 5;                ///< [s] after a longer gap, the landmark may have been moved
  double confidence = 0.999;           ///< probability that measurements at one place are recognized as such

  static const base::OptionTable<DynamicLandmarksOptions>& table();
};

/// Finds the landmarks that were moved (thesis 4.6). Expectation maximization on a copy of the graph estimates one
/// weight per landmark. The measurements of each landmark with a small weight are then clustered by the places where it
/// was seen. Moved landmarks are retired and no longer affect the map; for each of them, a landmark of kind "moved
/// thing" records the places. If the measurements at no single place determine a landmark with a small weight, it is
/// retired without a record. At the first key frame, Error(unknown_key) is thrown if `landmarks` has a name that is
/// neither a plugin's section nor the owner of a landmark.
class DynamicLandmarksPlugin : public mapper::MeasurementPlugin {
 public:
  static constexpr const char* kName = "MoveableThingsPlugin";
  static constexpr const char* kSummary = "Finds landmarks that were moved, and records the places where they were.";
  static void registerKinds(mapper::Kinds& kinds);

  DynamicLandmarksPlugin(const DynamicLandmarksOptions& options, const mapper::PluginContext& context);

  bool wants(const mrpt::obs::CObservation&) const override { return false; }
  bool worksOnLandmarks() const override { return true; }
  mapper::Batch measure(const map::KeyFrame&, const mapper::Observed&, const mapper::View&) override { return {}; }
  mapper::FollowUp afterCommit(const map::KeyFrame& frame, const mapper::View& view) override;
  mapper::Batch atEnd(const mapper::View& view) override;

 private:
  void refuseUnknownSections(const map::Map& map);

  DynamicLandmarksOptions options_;
  std::string section_;
  std::string config_text_;  // empty once options_.landmarks has been checked against it
  std::size_t searched_at_solve_ = 0;
};

}  // namespace omnimapper::plugins
