#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <chrono>
#include <memory>
#include <string>

namespace omnimapper::plugins {

struct LiveWindowOptions {
  int width = 1200, height = 900;  ///< [pixels]
  int points_per_key_frame = 400;
  double max_range = 30.0;  ///< [m]
  bool grid = true;
  double grid_resolution = 0.1;  ///< [m]
  bool follow = true;
  bool keep_open = true;

  static const base::OptionTable<LiveWindowOptions>& table();
};

class LiveScene;

/// A 3D window of MRPT that shows the map while it grows: occupancy grid, points, trajectory, closures, landmarks and
/// the newest pose. It is redrawn after each solve, and up to five times a second in between; the pose moves with every
/// frame, up to 30 times a second. The window may be closed at any time; the run goes on.
class LiveWindow : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "LiveWindow";
  static constexpr const char* kSummary = "Shows the map in a 3D window while it grows (--gui).";

  /// Throws Error(command_line) if there is no display, and Error(plugin_library) if the feature live_scene is missing.
  LiveWindow(const LiveWindowOptions& options, const mapper::PluginContext& context);
  ~LiveWindow() override;
  void update(const mapper::View& view) override;
  void keyFrameAdded(const mapper::View& view) override;
  void frameAdded(const mapper::View& view) override;
  /// Shows the final map.
  void finish(const mapper::View& view) override;
  /// Whether the window is open and should stay open.
  bool isLookedAt() const override { return options_.keep_open && isOpen(); }

  bool isOpen() const;

 private:
  LiveWindowOptions options_;
  std::unique_ptr<LiveScene> scene_;
  using Clock = std::chrono::steady_clock;
  Clock::time_point next_ = Clock::now();  // earliest time of the next drawing that does not follow a solve
  Clock::time_point next_move_ = next_;
};

}  // namespace omnimapper::plugins
