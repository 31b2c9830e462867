#pragma once

#include <omnimapper/derived/MapPoints.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>

namespace omnimapper::plugins {

/// Writes points.ply (binary, little-endian; x y z [m] in the map, red green blue): the point clouds of the key frames
/// if there are any, else the end points of their 2D scans' beams; and landmarks.ply, the landmarks as a coloured mesh,
/// in a separate file because viewers show either points or faces of a file. Moved landmarks are left out. Files that
/// would be empty are not written.
class PointsOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "PointsOutput";
  static constexpr const char* kSummary =
      "Writes points.ply, the coloured points of all key frames, and landmarks.ply.";

  PointsOutput(const derived::PointsOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const mapper::View& view) override;

 private:
  derived::PointsOptions options_;
  std::string path_, landmarks_path_;
};

}  // namespace omnimapper::plugins
