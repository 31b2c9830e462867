#pragma once

#include <omnimapper/building/RoomEdits.h>
#include <omnimapper/plugin/MeasurementPlugin.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <string>

namespace omnimapper::plugins {

struct RoomsOptions {
  double resolution = 0.05;    ///< [m]
  double max_range = 30.0;     ///< [m]
  double robot_radius = 0.15;  ///< [m]
  std::string edits;           ///< file; empty: none

  static const base::OptionTable<RoomsOptions>& table();
};

/// Finds the rooms of a finished map and sets its layer "rooms": from the occupancy grid, the way of the robot, through
/// which no wall goes, and the door signs, which name the rooms behind their doors (building::segmentRooms(),
/// nameBySigns()). When a map is continued, its rooms keep their ids (building::continueRooms()) and the edits of users
/// (building::RoomEdits). A map without 2D scans has no rooms. It measures nothing.
class RoomsPlugin : public mapper::MeasurementPlugin {
 public:
  static constexpr const char* kName = "RoomsPlugin";
  static constexpr const char* kSummary = "Finds the rooms and doors of the finished map; signs name them.";
  static void registerKinds(mapper::Kinds& kinds);

  /// Throws Error(unreadable_input) if there is a file of edits that cannot be read (building::readEdits()).
  RoomsPlugin(const RoomsOptions& options, const mapper::PluginContext& context);

  bool wants(const mrpt::obs::CObservation&) const override { return false; }
  bool worksOnLandmarks() const override { return true; }
  mapper::Batch measure(const map::KeyFrame&, const mapper::Observed&, const mapper::View&) override { return {}; }
  mapper::Batch atEnd(const mapper::View& view) override;

 private:
  RoomsOptions options_;
  std::string section_;
  building::RoomEdits edits_;  // of the file
};

}  // namespace omnimapper::plugins
