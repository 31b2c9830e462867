#include "MarkerDrawing.h"

#include <omnimapper/camera/PictureView.h>
#include <omnimapper/draw/Drawing.h>
#include <omnimapper/geometry/Conversions.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>

#include "IndexRgb.h"

namespace omnimapper::pictures {

namespace {

draw::Rgb colourOf(int number) {
  return indexRgb(static_cast<std::size_t>(std::max(0, number)));
}

// The measured point in the sensor frame, x forward, y left, z up [m]; MRPT's pitch is positive downwards.
Eigen::Vector3d pointInSensor(const mrpt::obs::CObservationBearingRange::TMeasurement& measured) {
  const double level = measured.range * std::cos(measured.pitch);
  return {level * std::cos(measured.yaw), level * std::sin(measured.yaw), -measured.range * std::sin(measured.pitch)};
}

}  // namespace

void drawMarkers(draw::Image& picture, const mrpt::img::TCamera& camera, const geometry::Se3& base_from_camera,
                 const mrpt::obs::CObservationBearingRange& found, std::vector<draw::LegendRow>& legend) {
  const auto camera_from_finder = geometry::inverse(base_from_camera) * geometry::fromMrpt(found.sensorLocationOnRobot);
  std::size_t drawn = 0;
  for (const auto& measured : found.sensedData) {
    const auto pixel = camera::pixelOf(camera, camera_from_finder * pointInSensor(measured));
    // A point far outside the picture is skipped: its pixel may not even be representable.
    if (!pixel || !(pixel->cwiseAbs().maxCoeff() < 2 * std::max(picture.width, picture.height))) continue;
    ++drawn;
    const draw::PixelPoint place{pixel->x() + 0.5, pixel->y() + 0.5};
    drawDot(picture, place, {{0, 0, 0}, 10});
    drawDot(picture, place, {colourOf(measured.landmarkID), 7});
    const bool is_inside = place.x > 0 && place.x < picture.width && place.y > 0 && place.y < picture.height;
    if (is_inside && measured.landmarkID >= 0) {
      draw::drawLabel(picture, static_cast<int>(place.x) + 8, static_cast<int>(place.y) - 7,
                      std::to_string(measured.landmarkID));
    }
  }
  if (drawn == 0) return;
  legend.push_back({colourOf(found.sensedData.front().landmarkID),
                    std::to_string(drawn) + " markers, a colour for each number: middle, number"});
}

}  // namespace omnimapper::pictures
