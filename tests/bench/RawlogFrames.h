#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/camera/RgbdView.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/source/openLogs.h>

#include <optional>
#include <string>
#include <vector>

#include "RgbdFrames.h"

namespace omnimapper::bench {

struct PosedFrames {
  std::vector<RgbdFrame> frames;
  std::vector<std::optional<geometry::Se3>> poses;  ///< world_from_camera (optical) at the stamps of the depth images
};

inline RgbdFrame frameOf(const mrpt::obs::CObservation3DRangeScan& scan) {
  const camera::RgbdView view(scan);
  const auto& depth = view.depth();
  RgbdFrame frame{depth.width(), depth.height(), depth.metresPerUnit(), depth.camera(), 0, 0, {}, {}};
  frame.stamp = frame.colour_stamp = mrpt::Clock::toDouble(scan.timestamp);
  const auto pixels = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
  if (!depth.units() || !view.colour())
    throw std::runtime_error("an observation needs depths of 16 bits and a colour image");
  frame.units.assign(depth.units(), depth.units() + pixels);
  const auto& colour = *view.colour();
  const bool is_bgr = colour.order == camera::ColourImage::Order::bgr;
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* row = colour.pixels + static_cast<std::ptrdiff_t>(y) * colour.stride;
    for (int x = 0; x < frame.width; ++x, row += 3) {
      frame.rgb.push_back(row[is_bgr ? 2 : 0]);
      frame.rgb.push_back(row[1]);
      frame.rgb.push_back(row[is_bgr ? 0 : 2]);
    }
  }
  return frame;
}

/// Reads the images of the range camera of a rawlog, and the true poses of the base from a TUM file.
inline PosedFrames readRawlog(const std::string& rawlog, const std::string& truth_file) {
  PosedFrames posed;
  const auto truth = eval::readTum(truth_file);
  const auto never = [] { return false; };
  const auto log = source::openLogs({rawlog}, {}, never);
  while (const auto observation = log->next()) {
    const auto scan = std::dynamic_pointer_cast<const mrpt::obs::CObservation3DRangeScan>(observation);
    if (!scan) continue;
    posed.frames.push_back(frameOf(*scan));
    auto pose = eval::interpolatedPose(truth, scan->timestamp, base::durationFromSeconds(0.1));
    if (pose) pose = *pose * geometry::fromMrpt(scan->sensorPose) * geometry::sensorFromOptical();
    posed.poses.push_back(pose);
  }
  return posed;
}

}  // namespace omnimapper::bench
