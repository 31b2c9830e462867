#pragma once

#include <omnimapper/camera/RgbdView.h>
#include <omnimapper/perception/Blackboard.h>

namespace omnimapper::perception {

/// The decoded images of the observation that the blackboard is of. Throws as RgbdView.
inline const camera::RgbdView& viewOf(const mrpt::obs::CObservation3DRangeScan& scan, Blackboard& board) {
  return board.get<camera::RgbdView>([&] { return std::make_shared<const camera::RgbdView>(scan); });
}

}  // namespace omnimapper::perception
