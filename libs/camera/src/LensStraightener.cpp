#include <omnimapper/camera/LensStraightener.h>
#include <omnimapper/camera/RangeScan.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace omnimapper::camera {

using mrpt::obs::CObservation3DRangeScan;

/// For each pixel of the straightened image, the place in the original image that shows the same ray.
struct LensStraightener::Map {
  Map(const mrpt::img::TCamera& of, const cv::Size& pixels);

  mrpt::img::TCamera camera;
  cv::Size size;
  cv::Mat columns, rows;  // [px] of 32 bits
  double max_shift = 0;   // [px] largest distance between a pixel and its place in the original image
};

namespace {

bool isCalibration(const mrpt::img::TCamera& camera) {
  auto values = camera.getDistortionParamsAsVector();
  values.insert(values.end(), {camera.fx(), camera.fy(), camera.cx(), camera.cy()});
  constexpr double kFarthest = 1e6, kShortestFocal = 1;  // [px] the same limits as in DepthImage
  return camera.fx() >= kShortestFocal && camera.fy() >= kShortestFocal &&
         std::all_of(values.begin(), values.end(), [](double value) { return std::abs(value) <= kFarthest; });
}

// Depth at a place between pixels. On one surface it is interpolated in inverse depth, which is linear in an image of a
// plane; across an edge it is the nearest pixel's. 0 if there is none.
std::uint16_t depthAt(const mrpt::math::CMatrix_u16& depths, float column, float row) {
  constexpr int kSaturated = 65535;
  constexpr double kOneSurface = 0.05;  // largest difference of depths on one surface, relative to the depth
  const auto width = static_cast<float>(depths.cols()), height = static_cast<float>(depths.rows());
  if (!(column >= 0 && row >= 0 && column < width - 1 && row < height - 1)) return 0;
  const int x = static_cast<int>(column), y = static_cast<int>(row);
  const double u = static_cast<double>(column) - x, v = static_cast<double>(row) - y;
  const std::uint16_t around[4] = {depths(y, x), depths(y, x + 1), depths(y + 1, x), depths(y + 1, x + 1)};
  const auto [least, most] = std::minmax_element(std::begin(around), std::end(around));
  if (*least == 0 || *most == kSaturated || *most - *least > kOneSurface * *least)
    return around[(v < 0.5 ? 0 : 2) + (u < 0.5 ? 0 : 1)];
  const double inverse = (1 - v) * ((1 - u) / around[0] + u / around[1]) + v * ((1 - u) / around[2] + u / around[3]);
  return static_cast<std::uint16_t>(std::lround(1 / inverse));
}

// Whether the scan has a picture of 8 bits. A picture in a file is loaded.
bool hasPicture(const CObservation3DRangeScan& scan) {
  if (!scan.hasIntensityImage) return false;
  try {
    return !scan.intensityImage.isEmpty() && scan.intensityImage.getPixelDepth() == mrpt::img::PixelDepth::D8U;
  } catch (const mrpt::img::CExceptionExternalImageNotFound&) {
    refuseMissing(scan.sensorLabel, "colour", scan.intensityImage.getExternalStorageFile());
  }
}

mrpt::img::TCamera withoutLens(mrpt::img::TCamera camera) {
  camera.dist.fill(0);
  camera.distortion = mrpt::img::DistortionModel::none;
  return camera;
}

}  // namespace

LensStraightener::LensStraightener() = default;
LensStraightener::~LensStraightener() = default;

LensStraightener::Map::Map(const mrpt::img::TCamera& of, const cv::Size& pixels) : camera(of), size(pixels) {
  const cv::Matx33d matrix(camera.fx(), 0, camera.cx(), 0, camera.fy(), camera.cy(), 0, 0, 1);
  const auto lens = camera.getDistortionParamsAsVector();
  const bool has_lens = camera.distortion != mrpt::img::DistortionModel::none &&
                        std::any_of(lens.begin(), lens.end(), [](double value) { return value != 0; });
  if (has_lens && camera.distortion == mrpt::img::DistortionModel::kannala_brandt) {
    cv::fisheye::initUndistortRectifyMap(matrix, lens, cv::Matx33d::eye(), matrix, size, CV_32FC1, columns, rows);
  } else if (has_lens) {
    cv::initUndistortRectifyMap(matrix, lens, cv::noArray(), matrix, size, CV_32FC1, columns, rows);
  }
  for (int y = 0; y < columns.rows; ++y) {
    for (int x = 0; x < columns.cols; ++x) {
      const double off =
          std::hypot(static_cast<double>(columns.at<float>(y, x)) - x, static_cast<double>(rows.at<float>(y, x)) - y);
      max_shift = std::max(max_shift, off);
    }
  }
}

std::shared_ptr<const LensStraightener::Map> LensStraightener::mapOf(const mrpt::img::TCamera& camera, int width,
                                                                     int height, std::shared_ptr<const Map>& kept) {
  constexpr double kNegligibleShift = 1.0 / 3;  // [px]
  const cv::Size size(width, height);
  if (size.empty() || !isCalibration(camera)) return nullptr;
  auto map = std::atomic_load(&kept);
  if (!map || map->camera != camera || map->size != size) {
    map = std::make_shared<const Map>(camera, size);
    std::atomic_store(&kept, map);
  }
  return map->max_shift < kNegligibleShift ? nullptr : map;
}

CObservation3DRangeScan::ConstPtr LensStraightener::straightened(const CObservation3DRangeScan::ConstPtr& scan) const {
  const auto& depths = scan->rangeImage;
  const auto of_depths = scan->hasRangeImage ? mapOf(scan->cameraParams, static_cast<int>(depths.cols()),
                                                     static_cast<int>(depths.rows()), depth_)
                                             : nullptr;
  const auto of_picture = hasPicture(*scan)
                              ? mapOf(scan->cameraParamsIntensity, static_cast<int>(scan->intensityImage.getWidth()),
                                      static_cast<int>(scan->intensityImage.getHeight()), picture_)
                              : nullptr;
  if (of_depths == nullptr && of_picture == nullptr) return scan;
  const auto straight = CObservation3DRangeScan::Create();
  straight->timestamp = scan->timestamp;
  straight->sensorLabel = scan->sensorLabel;
  straight->sensorPose = scan->sensorPose;
  straight->maxRange = scan->maxRange;
  straight->stdError = scan->stdError;
  straight->range_is_depth = scan->range_is_depth;
  straight->rangeUnits = scan->rangeUnits;
  straight->hasRangeImage = scan->hasRangeImage;
  straight->hasIntensityImage = scan->hasIntensityImage;
  straight->intensityImageChannel = scan->intensityImageChannel;
  straight->relativePoseIntensityWRTDepth = scan->relativePoseIntensityWRTDepth;
  straight->cameraParams = of_depths != nullptr ? withoutLens(scan->cameraParams) : scan->cameraParams;
  straight->cameraParamsIntensity =
      of_picture != nullptr ? withoutLens(scan->cameraParamsIntensity) : scan->cameraParamsIntensity;
  straight->rangeImage = depths;
  if (of_depths != nullptr) {
    for (int y = 0; y < of_depths->size.height; ++y)
      for (int x = 0; x < of_depths->size.width; ++x)
        straight->rangeImage(y, x) =
            depthAt(depths, of_depths->columns.at<float>(y, x), of_depths->rows.at<float>(y, x));
  }
  straight->intensityImage = scan->intensityImage;
  if (of_picture != nullptr) {
    cv::Mat picture;
    cv::remap(scan->intensityImage.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY), picture, of_picture->columns,
              of_picture->rows, cv::INTER_LINEAR);
    straight->intensityImage = mrpt::img::CImage(picture, mrpt::img::DEEP_COPY);
  }
  return straight;
}

}  // namespace omnimapper::camera
