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
  PointsOutput(const derived::PointsOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const mapper::View& view) override;

 private:
  derived::PointsOptions options_;
  std::string path_, landmarks_path_;
};

class PointsOutputFactory : public mapper::OutputPluginFactory {
  DEFINE_MRPT_OBJECT(PointsOutputFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "PointsOutput"; }
  std::string summary() const override {
    return "Writes points.ply, the coloured points of all key frames, and landmarks.ply.";
  }
  const std::vector<base::OptionSpec>& options() const override { return derived::PointsOptions::table().specs(); }
  std::unique_ptr<mapper::OutputPlugin> make(const base::ConfigSection& section,
                                             const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
