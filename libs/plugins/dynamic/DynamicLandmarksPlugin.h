#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct DynamicLandmarksOptions {
  std::vector<std::string> landmarks;  ///< INI sections; none: of every section
  int every_solves = 0;                ///< also after so many solves; 0: at the end alone
  double max_weight = 0.8;             ///< a landmark of less is looked at
  int min_measurements = 2;            ///< of a place
  double min_move = 0.15;              ///< [m]
  double visit_gap = 5;                ///< [s]
  double confidence = 0.999;           ///< measurements of one place are taken for that with this probability

  static const base::OptionTable<DynamicLandmarksOptions>& table();
};

/// Finds out landmarks that were moved (thesis 4.6): expectation maximisation over one weight per landmark, on a copy
/// of the graph; then measurements of those with little weight are told apart into the places where they were seen.
/// Moved ones are retired, no longer bear on the map, and stay in it as a landmark of kind "moved thing" that lists
/// their places. Those with little weight that were nowhere seen often enough are retired without. The first key frame
/// throws Error(unknown_key) if `landmarks` names what is neither a plugin's section nor the owner of a landmark.
class DynamicLandmarksPlugin : public mapper::MeasurementPlugin {
 public:
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
  std::string config_text_;  // until the names in it are checked
  std::size_t looked_at_solve_ = 0;
};

class DynamicLandmarksPluginFactory : public mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(DynamicLandmarksPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "MoveableThingsPlugin"; }
  std::string summary() const override { return "Landmarks that were moved, found out, with the places they were at."; }
  const std::vector<base::OptionSpec>& options() const override { return DynamicLandmarksOptions::table().specs(); }
  void registerKinds(mapper::Kinds& kinds) const override;
  std::unique_ptr<mapper::MeasurementPlugin> make(const base::ConfigSection& section,
                                                  const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
