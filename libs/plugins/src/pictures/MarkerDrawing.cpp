#include "MarkerDrawing.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/obs/IndexColour.h>
#include <omnimapper/perception/PictureView.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../output/Drawing.h"

namespace omnimapper::plugins {

namespace {

// MRPT: yaw to the left, pitch down.
Eigen::Vector3d pointOf(const mrpt::obs::CObservationBearingRange::TMeasurement& measured) {
  const double range = measured.range, yaw = measured.yaw, pitch = measured.pitch;
  return range * Eigen::Vector3d(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), -std::sin(pitch));
}

Rgb colourOf(int number) {
  const auto colour = obs::indexColour(static_cast<std::size_t>(std::max(0, number)));
  return {colour.R, colour.G, colour.B};
}

}  // namespace

void drawMarkers(Image& picture, const mrpt::img::TCamera& camera, const mrpt::poses::CPose3D& base_from_camera,
                 const mrpt::obs::CObservationBearingRange& found, std::vector<LegendRow>& legend) {
  if (found.sensedData.empty()) return;
  const auto camera_from_finder =
      geometry::inverse(geometry::fromMrpt(base_from_camera)) * geometry::fromMrpt(found.sensorLocationOnRobot);
  for (const auto& measured : found.sensedData) {
    const auto pixel = perception::pixelOf(camera, camera_from_finder * pointOf(measured));
    // Far outside nothing of it is seen, and its place may be no pixel at all.
    if (!pixel || !(pixel->cwiseAbs().maxCoeff() < 2 * std::max(picture.width, picture.height))) continue;
    const PixelPoint place{pixel->x() + 0.5, pixel->y() + 0.5};
    drawDot(picture, place, {{0, 0, 0}, 10});
    drawDot(picture, place, {colourOf(measured.landmarkID), 7});
    const bool is_inside = place.x > 0 && place.x < picture.width && place.y > 0 && place.y < picture.height;
    if (is_inside && measured.landmarkID >= 0) {
      drawLabel(picture, static_cast<int>(place.x) + 8, static_cast<int>(place.y) - 7,
                std::to_string(measured.landmarkID));
    }
  }
  legend.push_back({colourOf(found.sensedData.front().landmarkID),
                    std::to_string(found.sensedData.size()) + " markers, a colour for each number: middle, number"});
}

}  // namespace omnimapper::plugins
