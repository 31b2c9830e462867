#include <omnimapper/drivers/KinectConversion.h>

#include <cmath>

#include "kinect/KinectLens.h"

namespace omnimapper::drivers {

namespace {

constexpr double kUnit = 0.0002;  // [m] 13 m fit into 16 bits, and half of it is a tenth of the device's steps
constexpr double kMillimetre = 0.001;
constexpr std::size_t kPixels = static_cast<std::size_t>(kKinectWidth) * kKinectHeight;

// From the optical frame (x right, y down, z forward) to MRPT's sensor frame (x forward, y left, z up).
const mrpt::poses::CPose3D& sensorFromOpticalAxes() {
  static const mrpt::poses::CPose3D pose(0, 0, 0, -M_PI / 2, 0, -M_PI / 2);
  return pose;
}

std::uint16_t unitsOf(double metres) {
  return static_cast<std::uint16_t>(std::lround(metres / kUnit));
}

mrpt::img::CImage imageOf(const std::uint8_t* red_green_blue) {
  mrpt::img::CImage image(kKinectWidth, kKinectHeight, mrpt::img::CH_RGB);
  for (unsigned row = 0; row < kKinectHeight; ++row) {
    auto* to = image.ptrLine<std::uint8_t>(row);  // MRPT's images have blue first
    for (int column = 0; column < kKinectWidth; ++column, to += 3, red_green_blue += 3) {
      to[0] = red_green_blue[2];
      to[1] = red_green_blue[1];
      to[2] = red_green_blue[0];
    }
  }
  return image;
}

}  // namespace

KinectConversion::KinectConversion(const KinectOptions& options)
    : options_(options), depth_camera_(options.depthCamera()), picture_camera_(options.pictureCamera()) {
  const bool is_raw = options.registration != KinectOptions::Registration::device;
  const int values = is_raw ? kKinectNoDepth + 1 : 1 << 16;
  for (int value = 0; value < values; ++value) {
    const double depth = is_raw ? options.depthOf(value) : value * kMillimetre;
    metres_.push_back(depth <= options.max_range ? depth : 0);
    units_.push_back(unitsOf(metres_.back()));
  }
  // In the INI the colour camera's frame is optical, but the depth camera's is not.
  const auto picture_from_depth = (mrpt::poses::CPose3D() - options.depthFromPicture()) + sensorFromOpticalAxes();
  const auto& rotation = picture_from_depth.getRotationMatrix();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rotation_[row][column] = rotation(row, column);
  }
  translation_ = {picture_from_depth.x(), picture_from_depth.y(), picture_from_depth.z()};
  if (!isMoved()) return;
  rays_.reserve(kPixels);
  for (int row = 0; row < kKinectHeight; ++row) {
    for (int column = 0; column < kKinectWidth; ++column) rays_.push_back(rayOf(column, row));
  }
}

// The ray of a pixel of the depth camera, in the colour camera's frame; 0 if the lens images nothing there.
KinectConversion::Ray KinectConversion::rayOf(int column, int row) const {
  const auto& camera = depth_camera_;
  const auto in_depth = undistort(camera, {(column - camera.cx()) / camera.fx(), (row - camera.cy()) / camera.fy()});
  if (!in_depth) return {0, 0, 0};
  const auto along = [&](int axis) {
    const auto& r = rotation_[axis];
    return static_cast<float>(r[0] * in_depth->x + r[1] * in_depth->y + r[2]);
  };
  return {along(0), along(1), along(2)};
}

// Whether this class registers the depths to the picture. Without pictures they stay unregistered.
bool KinectConversion::isMoved() const {
  return options_.registration == KinectOptions::Registration::ours && options_.grab_image;
}

std::optional<KinectConversion::Place> KinectConversion::placeInPicture(int column, int row, double depth) const {
  return placeOf(rayOf(column, row), depth);
}

std::optional<KinectConversion::Place> KinectConversion::placeOf(Ray ray, double depth) const {
  const double z = depth * static_cast<double>(ray.z) + translation_[2];
  if ((ray.x == 0 && ray.y == 0 && ray.z == 0) || !(z > 0)) return std::nullopt;
  const NormalizedPoint image = distort(picture_camera_, {(depth * static_cast<double>(ray.x) + translation_[0]) / z,
                                                          (depth * static_cast<double>(ray.y) + translation_[1]) / z});
  const double u = picture_camera_.fx() * image.x + picture_camera_.cx();
  const double v = picture_camera_.fy() * image.y + picture_camera_.cy();
  if (!(u >= -0.5 && v >= -0.5 && u < kKinectWidth - 0.5 && v < kKinectHeight - 0.5)) return std::nullopt;
  return Place{static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v)), z};
}

// If several pixels of the depth camera fall on one pixel of the picture, the nearest depth is taken.
void KinectConversion::moveIntoPicture(const std::uint16_t* depths, mrpt::math::CMatrix_u16& image) const {
  image.fill(0);
  for (const Ray& ray : rays_) {
    const std::uint16_t value = *depths++;
    const double depth = value < metres_.size() ? metres_[value] : 0;
    const auto place = depth > 0 ? placeOf(ray, depth) : std::nullopt;
    if (!place || place->depth > options_.max_range) continue;
    const std::uint16_t units = unitsOf(place->depth);
    auto& kept = image(place->row, place->column);
    if (kept == 0 || units < kept) kept = units;
  }
}

void KinectConversion::fillCameras(mrpt::obs::CObservation3DRangeScan& scan) const {
  const bool is_of_depth_camera = options_.registration != KinectOptions::Registration::device && !isMoved();
  scan.cameraParamsIntensity = picture_camera_;
  scan.cameraParams = is_of_depth_camera ? depth_camera_ : picture_camera_;
  scan.relativePoseIntensityWRTDepth = is_of_depth_camera ? options_.depthFromPicture() : sensorFromOpticalAxes();
  scan.sensorPose = options_.baseFromSensor();
  if (!is_of_depth_camera)
    scan.sensorPose =
        scan.sensorPose + options_.depthFromPicture() + (mrpt::poses::CPose3D() - sensorFromOpticalAxes());
}

mrpt::obs::CObservation3DRangeScan::Ptr KinectConversion::observation(const std::uint16_t* depths,
                                                                      const std::uint8_t* picture) const {
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  fillCameras(*scan);
  scan->maxRange = static_cast<float>(options_.max_range);
  scan->range_is_depth = true;
  scan->rangeUnits = static_cast<float>(kUnit);
  scan->hasRangeImage = true;
  scan->rangeImage_setSize(kKinectHeight, kKinectWidth);
  if (isMoved()) {
    moveIntoPicture(depths, scan->rangeImage);
  } else {
    auto* to = scan->rangeImage.data();
    for (std::size_t i = 0; i < kPixels; ++i) to[i] = depths[i] < units_.size() ? units_[depths[i]] : 0;
  }
  scan->hasIntensityImage = picture != nullptr;
  if (picture) scan->intensityImage = imageOf(picture);
  return scan;
}

}  // namespace omnimapper::drivers
