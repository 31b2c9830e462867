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
  GridOutput(const GridOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const mapper::View& view) override;

 private:
  GridOptions options_;
  std::string path_;  // without extension
};

class GridOutputFactory : public mapper::OutputPluginFactory {
  DEFINE_MRPT_OBJECT(GridOutputFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "GridOutput"; }
  std::string summary() const override { return "Writes grid.pgm, grid.yaml (ROS map_server) and grid.png."; }
  const std::vector<base::OptionSpec>& options() const override { return GridOptions::table().specs(); }
  std::unique_ptr<mapper::OutputPlugin> make(const base::ConfigSection& section,
                                             const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
