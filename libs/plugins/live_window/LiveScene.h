#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/plugin/View.h>

#include <string>

#include "LiveWindow.h"

namespace omnimapper::plugins {

/// An open window on the screen that draws a map. It is implemented by a feature of its own, live_scene, which
/// LiveWindow loads when a window opens: MRPT's windows need many libraries, which would slow down the start of every
/// program for a rarely used feature.
class LiveScene {
 public:
  virtual ~LiveScene() = default;
  virtual bool isOpen() const = 0;
  virtual void show(const mapper::View& view) = 0;
  /// Moves the drawn robot to this pose.
  virtual void move(const mrpt::poses::CPose3D& map_from_base) = 0;
};

}  // namespace omnimapper::plugins

/// The function that the feature live_scene exports. The caller owns the scene. Throws Error(command_line) if there
/// is no display.
extern "C" omnimapper::plugins::LiveScene* omnimapperOpenLiveScene(
    const omnimapper::plugins::LiveWindowOptions& options, const std::string& title);
