#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/camera/LensModel.h>
#include <omnimapper/camera/PictureView.h>
#include <omnimapper/camera/RangeScan.h>

namespace omnimapper::camera {

namespace {

bool isOneCamera(const mrpt::img::TCamera& a, const mrpt::img::TCamera& b) {
  return a.fx() == b.fx() && a.fy() == b.fy() && a.cx() == b.cx() && a.cy() == b.cy();
}

}  // namespace

bool bringsPicture(const mrpt::obs::CObservation& observation) {
  if (dynamic_cast<const mrpt::obs::CObservationImage*>(&observation) != nullptr) return true;
  const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation);
  return scan != nullptr && scan->hasIntensityImage;
}

Picture pictureOf(const mrpt::obs::CObservation& observation) {
  const auto* view = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation);
  const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation);
  if (!bringsPicture(observation)) return {nullptr, nullptr, {}};
  const auto& image = view != nullptr ? view->image : scan->intensityImage;
  try {
    const auto* loaded = image.isEmpty() ? nullptr : &image;
    if (loaded != nullptr) loaded->getWidth();  // loads the image
    if (view != nullptr) return {loaded, &view->cameraParams, view->cameraPose};
    return {loaded, isPictureOfDepthView(*scan) ? &scan->cameraParams : &scan->cameraParamsIntensity,
            scan->sensorPose + scan->relativePoseIntensityWRTDepth};
  } catch (const mrpt::img::CExceptionExternalImageNotFound&) {
    refuseMissing(observation.sensorLabel, "colour", image.getExternalStorageFile());
  }
}

// doDepthAndIntensityCamerasCoincide() compares only the poses of the cameras, so the rest is compared here.
bool isPictureOfDepthView(const mrpt::obs::CObservation3DRangeScan& scan) {
  const auto& image = scan.intensityImage;
  const auto& camera = scan.cameraParamsIntensity;
  return scan.hasIntensityImage && !image.isEmpty() &&
         static_cast<int>(image.getWidth()) == static_cast<int>(scan.rangeImage.cols()) &&
         static_cast<int>(image.getHeight()) == static_cast<int>(scan.rangeImage.rows()) &&
         scan.doDepthAndIntensityCamerasCoincide() && (camera.fx() == 0 || isOneCamera(scan.cameraParams, camera));
}

std::optional<Eigen::Vector2d> pixelOf(const mrpt::img::TCamera& camera, const Eigen::Vector3d& point_in_sensor) {
  constexpr double kNearest = 0.01;  // [m]
  if (!(point_in_sensor.x() > kNearest)) return std::nullopt;
  try {
    const LensModel lens(camera, "camera");
    return lens.project(toOptical(point_in_sensor)).place;
  } catch (const base::Error&) {
    return std::nullopt;
  }
}

}  // namespace omnimapper::camera
