#include <omnimapper/base/Error.h>
#include <omnimapper/camera/DepthImage.h>

#include <cmath>
#include <string>

namespace omnimapper::camera {

namespace {

constexpr int kLongestSide = 4096;
// Limits [px] that no real calibration exceeds. Beyond them, computations with its parameters overflow.
constexpr double kShortestFocal = 1, kFarthest = 1e6;

[[noreturn]] void refuse(const std::string& why) {
  throw base::Error(base::ExitCode::unreadable_input, "depth image: " + why);
}

void check(const void* pixels, int width, int height, const Pinhole& camera) {
  if (width < 0 || height < 0 || width > kLongestSide || height > kLongestSide) {
    refuse("a size of " + std::to_string(width) + " x " + std::to_string(height) + " is outside 0 to " +
           std::to_string(kLongestSide));
  }
  if (pixels == nullptr && width > 0 && height > 0) refuse("it has a size but no pixels");
  for (const double value : {camera.fx, camera.fy, camera.cx, camera.cy}) {
    if (!(std::abs(value) <= kFarthest)) {  // also true of NaN
      refuse("an intrinsic parameter of " + std::to_string(value) + " px is beyond " + std::to_string(kFarthest) +
             " px; calibrate the camera");
    }
  }
  for (const double focal : {camera.fx, camera.fy}) {
    if (focal < kShortestFocal) {
      refuse("a focal length of " + std::to_string(focal) +
             " px is not positive and at least a pixel; calibrate the camera (depth_fx_px and depth_fy_px in "
             "[calibration])");
    }
  }
}

}  // namespace

DepthImage::DepthImage(const std::uint16_t* units, double metres_per_unit, int width, int height, const Pinhole& camera)
    : units_(units), metres_per_unit_(metres_per_unit), width_(width), height_(height), camera_(camera) {
  check(units, width, height, camera);
  if (!std::isfinite(metres_per_unit) || metres_per_unit <= 0) {
    refuse("a depth unit of " + std::to_string(metres_per_unit) + " m is not positive");
  }
}

DepthImage::DepthImage(const float* metres, int width, int height, const Pinhole& camera)
    : metres_(metres), width_(width), height_(height), camera_(camera) {
  check(metres, width, height, camera);
}

}  // namespace omnimapper::camera
