#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>

namespace omnimapper::plugins {

struct GridOptions {
  double resolution = 0.05;  ///< [m]
  double max_range = 30.0;   ///< [m]
  double margin = 0.5;       ///< [m]
  int max_megacells = 40;    ///< [10^6 cells]

  static const base::OptionTable<GridOptions>& table();
};

/// Writes the occupancy grid of the 2D scans: grid.pgm and grid.yaml for ROS map_server, and grid.png for viewing. A
/// map without scans has no grid, and no file is written.
class GridOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "GridOutput";
  static constexpr const char* kSummary = "Writes grid.pgm, grid.yaml (ROS map_server) and grid.png.";

  GridOutput(const GridOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const mapper::View& view) override;

 private:
  GridOptions options_;
  std::string path_;  // without extension
};

}  // namespace omnimapper::plugins
