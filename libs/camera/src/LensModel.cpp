#include <omnimapper/base/Error.h>
#include <omnimapper/camera/LensModel.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

namespace omnimapper::camera {

namespace {

constexpr double kLeastFocal = 1, kMostParameter = 1e6;  // [px] the same limits as in DepthImage
constexpr double kWidestRay = 1e3;                       // tangent of the largest angle between a ray and the axis

cv::Matx33d matrixOf(const mrpt::img::TCamera& camera) {
  return {camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1};
}

bool isFisheye(const mrpt::img::TCamera& camera) {
  return camera.distortion == mrpt::img::DistortionModel::kannala_brandt;
}

}  // namespace

LensModel::LensModel(const mrpt::img::TCamera& camera, const std::string& who) : camera_(camera) {
  const auto refuse = [&](const std::string& why) {
    throw base::Error(base::ExitCode::unreadable_input, who + ": " + why + "; calibrate the camera");
  };
  auto values = camera.getDistortionParamsAsVector();
  values.insert(values.end(), {camera.fx(), camera.fy(), camera.cx(), camera.cy()});
  for (const double value : values) {
    if (!(std::abs(value) <= kMostParameter))  // not a number, too
      refuse("an intrinsic parameter of " + std::to_string(value) + " is beyond " + std::to_string(kMostParameter));
  }
  for (const double focal : {camera.fx(), camera.fy()}) {
    if (focal < kLeastFocal) refuse("a focal length of " + std::to_string(focal) + " px is shorter than a pixel");
  }
}

std::optional<Corners> LensModel::raysOf(const Corners& in_image) const {
  std::vector<cv::Point2d> places, rays;
  for (const auto& place : in_image) places.emplace_back(place.x(), place.y());
  const auto lens = camera_.getDistortionParamsAsVector();
  if (isFisheye(camera_)) {
    cv::fisheye::undistortPoints(places, rays, matrixOf(camera_), lens);
  } else {
    cv::undistortPoints(places, rays, matrixOf(camera_), lens);
  }
  Corners result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = {rays[i].x, rays[i].y};
    if (!(result[i].norm() < kWidestRay)) return std::nullopt;
  }
  return result;
}

LensModel::Projection LensModel::project(const Eigen::Vector3d& point) const {
  // The origin is translated to the point, so that derivatives with respect to the translation are those with respect
  // to the point.
  const std::vector<cv::Point3d> origin{{0, 0, 0}};
  const cv::Vec3d rotation(0, 0, 0), translation(point.x(), point.y(), point.z());
  const auto lens = camera_.getDistortionParamsAsVector();
  std::vector<cv::Point2d> places;
  cv::Mat by_all;
  const bool fisheye = isFisheye(camera_);
  if (fisheye) {
    cv::fisheye::projectPoints(origin, places, rotation, translation, matrixOf(camera_), lens, 0, by_all);
  } else {
    cv::projectPoints(origin, rotation, translation, matrixOf(camera_), lens, places, by_all);
  }
  // Columns: focal lengths, centre, lens, rotation, translation; or rotation, translation, ...
  const int first = fisheye ? 11 : 3;
  Projection projection{{places[0].x, places[0].y}, {}};
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column)
      projection.by_point(row, column) = by_all.at<double>(row, first + column);
  return projection;
}

}  // namespace omnimapper::camera
