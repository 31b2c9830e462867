#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <string>

namespace omnimapper::plugins {

/// This output has no options.
struct RoomFilesOutputOptions {
  static const base::OptionTable<RoomFilesOutputOptions>& table();
};

/// Writes the rooms that RoomsPlugin found (doc/rooms.md): rooms.json for programs, rooms.png, a picture of the grid
/// with the rooms, plan.svg, a floor plan, and scene_graph.json (doc/scene_graph.md). A map without the layer has none
/// of these files.
class RoomFilesOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "RoomFilesOutput";
  static constexpr const char* kSummary =
      "Writes the rooms of RoomsPlugin: rooms.json, rooms.png, plan.svg, scene_graph.json.";

  RoomFilesOutput(const RoomFilesOutputOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const mapper::View& view) override;

 private:
  std::string title_, folder_;
};

}  // namespace omnimapper::plugins
