#pragma once

#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <string>

namespace omnimapper::plugins {

struct SceneOptions {
  double voxel = 0.05;          ///< [m] as in derived::PointsOptions
  double max_range = 30.0;      ///< [m]
  double corner_spacing = 2.0;  ///< [m] distance travelled between two drawn key frames
  bool refused_closures = false;
  bool names = true;  ///< names of landmarks are drawn

  static const base::OptionTable<SceneOptions>& table();
};

/// Writes scene.3Dscene, which SceneViewer3D opens: ground grid, points, trajectory, axes of some key frames, closures
/// (green, refused ones red) and landmarks: walls brown, tables violet, floors grey, ceilings light blue, surfaces
/// translucent with an arrow to their free side, moved ones as dashed outlines.
class SceneOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "SceneOutput";
  static constexpr const char* kSummary = "Writes scene.3Dscene for MRPT's program SceneViewer3D.";

  SceneOutput(const SceneOptions& options, const mapper::PluginContext& context);
  bool isOfMap() const override { return true; }
  void finish(const mapper::View& view) override;

 private:
  SceneOptions options_;
  std::string path_;
};

}  // namespace omnimapper::plugins
