#pragma once

#include <omnimapper/plugin/MeasurementPlugin.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/plugin/WatchesObservations.h>

#include <memory>
#include <string>
#include <vector>

namespace rooms_layer {

struct RoomNamesOptions {
  std::string label;  ///< empty: every reader of tags

  static const omnimapper::base::OptionTable<RoomNamesOptions>& table();
};

// Step 2: the plugin. It watches, so that it sees tags that are read while the robot stands still and no key frame is
// made.

/// Rooms by the RFID tags at their doors, each of which has the name of its room (CObservationRFID): the room is where
/// its tag was read with most power. The plugin keeps nothing itself: what it knows is the layer.
class RoomNamesPlugin : public omnimapper::mapper::MeasurementPlugin, public omnimapper::mapper::WatchesObservations {
 public:
  static constexpr const char* kName = "RoomNamesPlugin";
  static constexpr const char* kSummary = "Rooms by the RFID tags at their doors.";
  static void registerKinds(omnimapper::mapper::Kinds& kinds);

  explicit RoomNamesPlugin(const RoomNamesOptions& options) : options_(options) {}

  bool watches(const mrpt::obs::CObservation& observation) const override;
  omnimapper::mapper::WatchResult watch(const omnimapper::mapper::Watched& watched,
                                        const omnimapper::mapper::View& view) override;

  // It measures nothing at key frames.
  bool wants(const mrpt::obs::CObservation& /*observation*/) const override { return false; }
  omnimapper::mapper::Batch measure(const omnimapper::map::KeyFrame&, const omnimapper::mapper::Observed&,
                                    const omnimapper::mapper::View&) override {
    return {};
  }

 private:
  RoomNamesOptions options_;
};

}  // namespace rooms_layer
