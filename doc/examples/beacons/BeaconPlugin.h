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
  static constexpr const char* kName = "BeaconPlugin";
  static constexpr const char* kSummary = "Beacons with numbers, from ranges and bearings.";
  static void registerKinds(omnimapper::mapper::Kinds& kinds);

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

}  // namespace beacons
