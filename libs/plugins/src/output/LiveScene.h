#pragma once

#include <omnimapper/plugin/View.h>
#include <omnimapper/plugins/LiveWindow.h>

#include <string>

namespace omnimapper::plugins {

/// An open window on the screen that draws a map. Implemented by libomnimapper-window, which LiveWindow loads: MRPT's
/// windows bring many libraries, and every program would start later for something rarely used.
class LiveScene {
 public:
  virtual ~LiveScene() = default;
  virtual bool isOpen() const = 0;
  virtual void show(const mapper::View& view) = 0;
};

}  // namespace omnimapper::plugins

/// What libomnimapper-window exports. The caller owns the scene. Throws Error(command_line) if there is no display.
extern "C" omnimapper::plugins::LiveScene* omnimapperOpenLiveScene(
    const omnimapper::plugins::LiveWindowOptions& options, const std::string& title);
