#pragma once

#include <omnimapper/landmarks/LandmarkPlugin.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/SensorCorrections.h>

#include <memory>
#include <string>
#include <vector>

#include "BeaconAssociator.h"
#include "BeaconOptions.h"

namespace beacons {

// Step 6: the plugin. It gets observations and returns batches of edits. Its base class keeps the index of the beacons,
// also that of a map that is continued. The plugin never changes the map or the graph itself, and one thread calls it.

/// Beacons with numbers, from ranges and bearings (CObservationBearingRange). A beacon is added with its first
/// measurement; later measurements are associated by number and gated.
class BeaconPlugin : public omnimapper::landmarks::LandmarkPlugin<BeaconIndex> {
 public:
  BeaconPlugin(const BeaconOptions& options, const omnimapper::mapper::PluginContext& context);

  bool wants(const mrpt::obs::CObservation& observation) const override;
  void applied(const omnimapper::mapper::AppliedBatch& ids) override;

 protected:
  omnimapper::mapper::Batch associate(const omnimapper::map::KeyFrame& frame,
                                      const omnimapper::mapper::Observed& observed,
                                      const omnimapper::mapper::View& view) override;
  // Not needed here: merge(), because beacons have numbers; prepare(), because there is no heavy work; save(), because
  // the payloads of the landmarks have all that the index needs.

 private:
  BeaconOptions options_;
  omnimapper::mapper::SensorCorrections corrections_;
};

// Step 7: the factory, an MRPT run-time class without state, so that an INI can name the plugin: "class =
// BeaconPlugin".
class BeaconPluginFactory : public omnimapper::mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(BeaconPluginFactory, beacons)
 public:
  std::string name() const override { return "BeaconPlugin"; }
  std::string summary() const override { return "Beacons with numbers, from ranges and bearings."; }
  const std::vector<omnimapper::base::OptionSpec>& options() const override { return BeaconOptions::table().specs(); }
  void registerKinds(omnimapper::mapper::Kinds& kinds) const override;
  std::unique_ptr<omnimapper::mapper::MeasurementPlugin> make(
      const omnimapper::base::ConfigSection& section, const omnimapper::mapper::PluginContext& context) const override;
};

}  // namespace beacons
