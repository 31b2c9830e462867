#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>

namespace omnimapper::plugins {

struct ReportOptions {
  double resolution = 0.05;  ///< [m] side of a cell of the grid behind the map
  double max_range = 30.0;   ///< [m]
  int picture_side = 1600;   ///< [pixels] approximate length of the longer side
  int max_rows = 2000;       ///< largest number of listed rows of the decision log

  static const base::OptionTable<ReportOptions>& table();
};

/// Writes report.html, a self-contained page: the map from above with trajectory and closures, curves of error and
/// time, and the decision log with reasons; and map.png, the picture of the map alone.
class ReportOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "ReportOutput";
  static constexpr const char* kSummary =
      "Writes report.html, which explains the run, and map.png, a picture of the map.";

  ReportOutput(const ReportOptions& options, const mapper::PluginContext& context);
  void finish(const mapper::View& view) override;

 private:
  ReportOptions options_;
  mapper::PluginContext context_;
};

}  // namespace omnimapper::plugins
