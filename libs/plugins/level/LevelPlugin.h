#pragma once

#include <omnimapper/plugin/MeasurementPlugin.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/WatchesObservations.h>

#include <string>
#include <vector>

#include "LevelEvidence.h"
#include "estimateLevel.h"

namespace omnimapper::plugins {

/// Finds at the end of a run which way is up in the map (estimateLevel()), and sets the map's layer "level". Plugins
/// that judge surfaces at the end, such as PlaneLandmarksPlugin, come after it. A run that localizes keeps the level of
/// its map.
class LevelPlugin : public mapper::MeasurementPlugin, public mapper::HearsObservations {
 public:
  static constexpr const char* kName = "LevelPlugin";
  static constexpr const char* kSummary =
      "Finds which way is up in the map, by gravity, by surfaces, or by the base of a robot on wheels.";

  LevelPlugin(const LevelOptions& options, const mapper::PluginContext& context)
      : options_(options), motion_(context.motion) {}

  bool wants(const mrpt::obs::CObservation& /*observation*/) const override { return false; }
  bool worksOnLandmarks() const override { return true; }
  mapper::Batch measure(const map::KeyFrame& /*frame*/, const mapper::Observed& /*observed*/,
                        const mapper::View& /*view*/) override {
    return {};
  }
  void heard(const mrpt::obs::CObservation& observation) override { evidence_.add(observation); }
  mapper::Batch atEnd(const mapper::View& view) override;
  std::vector<std::string> warnings() const override { return warnings_; }

 private:
  LevelOptions options_;
  mapper::Motion motion_;
  LevelEvidence evidence_;
  std::vector<std::string> warnings_;
};

}  // namespace omnimapper::plugins
