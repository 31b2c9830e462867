#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/plugin/View.h>

#include <string>

#include "scene/LiveWindow.h"

namespace omnimapper::exports {

/// An open window on the screen that draws a map. Implemented by libomnimapper-window, which LiveWindow loads: MRPT's
/// windows bring many libraries, and every program would start later for something rarely used.
class LiveScene {
 public:
  virtual ~LiveScene() = default;
  virtual bool isOpen() const = 0;
  virtual void show(const mapper::View& view) = 0;
  /// The robot is there now.
  virtual void move(const mrpt::poses::CPose3D& map_from_base) = 0;
};

}  // namespace omnimapper::exports

/// What libomnimapper-window exports. The caller owns the scene. Throws Error(command_line) if there is no display.
extern "C" omnimapper::exports::LiveScene* omnimapperOpenLiveScene(
    const omnimapper::exports::LiveWindowOptions& options, const std::string& title);
