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

class RoomNamesPluginFactory : public omnimapper::mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(RoomNamesPluginFactory, rooms_layer)
 public:
  std::string name() const override { return "RoomNamesPlugin"; }
  std::string summary() const override { return "Rooms by the RFID tags at their doors."; }
  const std::vector<omnimapper::base::OptionSpec>& options() const override {
    return RoomNamesOptions::table().specs();
  }
  void registerKinds(omnimapper::mapper::Kinds& kinds) const override;
  std::unique_ptr<omnimapper::mapper::MeasurementPlugin> make(
      const omnimapper::base::ConfigSection& section, const omnimapper::mapper::PluginContext& context) const override;
};

}  // namespace rooms_layer
