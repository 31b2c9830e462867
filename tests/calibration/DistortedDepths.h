#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/camera/DepthDistortion.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace omnimapper::calibration {

/// Simulated depth images of planes, by a camera with a systematic distortion.
struct DistortedDepths {
  int width = 160, height = 120;
  double sigma = 0.0023;               ///< [1/m] noise of a pixel
  double nearest = 0.7, farthest = 3;  ///< [m] of the planes, in the middle of the image
  double turn = 0.35;                  ///< relative change of the inverse depth from the middle to a rim
  double share = 1;                    ///< of the columns that have depths
  bool has_floor = true;               ///< in every second image
  camera::DepthDistortion distortion;  ///< correction of the measured inverse depths

  /// The wall of image `number`: its inverse depth [1/m] over x and y from -1 to 1, as constant, slope in x and slope
  /// in y.
  Eigen::Vector3d wallOf(int number) const {
    std::mt19937 random(static_cast<unsigned>(1000 + number));
    const auto share_of = [&] { return static_cast<double>(random()) / static_cast<double>(std::mt19937::max()); };
    const double middle = 1 / (nearest + (farthest - nearest) * share_of());
    const double across = turn * (2 * share_of() - 1), down = turn * (2 * share_of() - 1);
    return middle * Eigen::Vector3d(1, across, down);
  }

  mrpt::obs::CObservation3DRangeScan imageOf(int number) const {
    mrpt::obs::CObservation3DRangeScan scan;
    scan.timestamp = base::stampFromUnix(1.6e9) + base::durationFromSeconds(0.1 * number);
    scan.sensorLabel = "camera";
    scan.hasRangeImage = scan.range_is_depth = true;
    scan.rangeUnits = 0.0005F;
    scan.cameraParams.setIntrinsicParamsFromValues(0.82 * width, 0.82 * width, 0.5 * (width - 1), 0.5 * (height - 1));
    scan.cameraParams.ncols = static_cast<std::uint32_t>(width);
    scan.cameraParams.nrows = static_cast<std::uint32_t>(height);
    scan.rangeImage_setSize(height, width);
    const auto wall = wallOf(number);
    std::mt19937 random(static_cast<unsigned>(number));
    std::normal_distribution<double> noise(0, sigma);
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        const double x = (2.0 * u + 1) / width - 1, y = (2.0 * v + 1) / height - 1;
        double inverse = wall.dot(Eigen::Vector3d(1, x, y));
        // Below the middle, a floor is nearer than the wall.
        if (has_floor && number % 2 == 0) inverse = std::max(inverse, 0.1 + 0.8 * y * wall[0] + 0.5 * wall[0]);
        inverse += noise(random) - distortion.at(x, y);
        scan.rangeImage(v, u) = u < share * width && inverse > 0.05
                                    ? static_cast<std::uint16_t>(std::lround(1 / inverse / 0.0005))
                                    : std::uint16_t{0};
      }
    }
    return scan;
  }
};

/// A distortion as that of a Kinect: 6 mm at 1 m in a corner.
inline camera::DepthDistortion kinectDistortion() {
  return camera::DepthDistortion(
      {-0.003, 0.0012, -0.001, 0.0015, 0.001, -0.0008, 0.0005, 0.001, -0.0015, 0.002, 0.0006, 0.0008});
}

}  // namespace omnimapper::calibration
