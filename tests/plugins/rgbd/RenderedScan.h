#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>

#include <cmath>

#include "../../matching/RenderedRoom.h"

namespace omnimapper::plugins {

/// The depth image of a base's camera in a rendered room, as in a rawlog. It is all zero if the lens is covered.
inline mrpt::obs::CObservation3DRangeScan::Ptr renderedScan(const matching::RenderedRoom& room,
                                                            const geometry::Se3& room_from_base,
                                                            const mrpt::poses::CPose3D& base_from_camera,
                                                            base::Stamp stamp, bool is_covered = false) {
  const auto image = room.render(room_from_base * geometry::fromMrpt(base_from_camera) * geometry::sensorFromOptical());
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  scan->timestamp = stamp;
  scan->sensorLabel = "camera";
  scan->sensorPose = base_from_camera;
  scan->hasRangeImage = scan->hasIntensityImage = true;
  scan->range_is_depth = true;
  scan->rangeUnits = 1e-4F;
  scan->rangeImage_setSize(room.height, room.width);
  scan->intensityImage.resize(room.width, room.height, mrpt::img::CH_GRAY);
  for (int y = 0; y < room.height; ++y) {
    for (int x = 0; x < room.width; ++x) {
      const auto pixel = static_cast<std::size_t>(y * room.width + x);
      scan->rangeImage(y, x) = is_covered ? 0 : static_cast<std::uint16_t>(std::lround(1e4 * image.depth[pixel]));
      *scan->intensityImage.ptr<std::uint8_t>(static_cast<unsigned>(x), static_cast<unsigned>(y)) =
          is_covered ? 0 : image.grey[pixel];
    }
  }
  for (auto* camera : {&scan->cameraParams, &scan->cameraParamsIntensity}) {
    camera->ncols = static_cast<std::uint32_t>(room.width);
    camera->nrows = static_cast<std::uint32_t>(room.height);
    camera->setIntrinsicParamsFromValues(room.camera.fx, room.camera.fy, room.camera.cx, room.camera.cy);
  }
  return scan;
}

}  // namespace omnimapper::plugins
