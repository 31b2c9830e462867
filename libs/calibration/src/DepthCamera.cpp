#include <omnimapper/calibration/DepthCamera.h>
#include <omnimapper/camera/PictureView.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>

namespace omnimapper::calibration {

namespace {

std::optional<Intrinsics> intrinsicsOf(const mrpt::img::TCamera& camera) {
  if (camera.distortion == mrpt::img::DistortionModel::kannala_brandt || !(camera.fx() > 1 && camera.fy() > 1))
    return std::nullopt;
  // A lens of eight coefficients is not supported: five would be fitted, and the other three would keep their old
  // values.
  if (camera.dist[5] != 0 || camera.dist[6] != 0 || camera.dist[7] != 0) return std::nullopt;
  const bool is_straight = camera.distortion == mrpt::img::DistortionModel::none;
  Intrinsics all{camera.fx(), camera.fy(), camera.cx(), camera.cy()};
  for (std::size_t i = 0; i < 5; ++i) all[4 + i] = is_straight ? 0 : camera.dist[i];
  return all;
}

}  // namespace

// The distortion of the lens is small, so it is removed by iteration (as in OpenCV).
Eigen::Vector3d rayThrough(const Intrinsics& camera, const Eigen::Vector2d& pixel) {
  constexpr int kRounds = 20;
  const Eigen::Vector2d focal(camera[0], camera[1]);
  Eigen::Vector3d ray((pixel.x() - camera[2]) / camera[0], (pixel.y() - camera[3]) / camera[1], 1);
  for (int i = 0; i < kRounds; ++i) ray.head<2>() += (pixel - project(camera.data(), ray)).cwiseQuotient(focal);
  return ray;
}

std::optional<DepthCamera> cameraOf(const mrpt::obs::CObservation3DRangeScan& scan) {
  DepthCamera camera;
  camera.is_registered = camera::isPictureOfDepthView(scan);
  const auto depth = intrinsicsOf(scan.cameraParams);
  const auto picture =
      intrinsicsOf(scan.cameraParamsIntensity.fx() == 0 ? scan.cameraParams : scan.cameraParamsIntensity);
  if (!depth || !picture) return std::nullopt;
  camera.depth = *depth;
  camera.picture = *picture;
  camera.width = static_cast<int>(scan.intensityImage.getWidth());
  camera.height = static_cast<int>(scan.intensityImage.getHeight());
  // MRPT's depth frame has x forward; the picture's frame is optical.
  if (!camera.is_registered)
    camera.depth_from_picture =
        inverse(geometry::sensorFromOptical()) * geometry::fromMrpt(scan.relativePoseIntensityWRTDepth);
  return camera;
}

}  // namespace omnimapper::calibration
