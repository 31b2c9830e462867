#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/base/Stamp.h>

#include <cmath>
#include <functional>

namespace omnimapper::camera::scans {

constexpr int kWidth = 160, kHeight = 120;
constexpr double kFocal = 100;   // [px]
constexpr float kUnits = 1e-4F;  // [m]

/// Calibration of a camera that looks along its middle.
inline mrpt::img::TCamera camera(int width, int height, double focal) {
  mrpt::img::TCamera camera;
  camera.setIntrinsicParamsFromValues(focal, focal, 0.5 * (width - 1), 0.5 * (height - 1));
  camera.ncols = static_cast<std::uint32_t>(width);
  camera.nrows = static_cast<std::uint32_t>(height);
  return camera;
}

/// Scan of a range camera without colours whose pixel in column x and row y measures `depth(x, y)` [m].
inline mrpt::obs::CObservation3DRangeScan rangeScan(const std::function<double(int, int)>& depth, int width = kWidth,
                                                    int height = kHeight) {
  mrpt::obs::CObservation3DRangeScan scan;
  scan.timestamp = base::stampFromUnix(1'000'000'000.25);
  scan.sensorLabel = "kinect";
  scan.sensorPose = mrpt::poses::CPose3D(0.1, 0, 1, 0, 0.2, 0);
  scan.hasRangeImage = true;
  scan.rangeUnits = kUnits;
  scan.cameraParams = scan.cameraParamsIntensity = camera(width, height, kFocal);
  scan.rangeImage_setSize(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double units = depth(x, y) / static_cast<double>(kUnits);
      scan.rangeImage(y, x) = units < 65535 ? static_cast<std::uint16_t>(units + 0.5) : 65535;
    }
  }
  return scan;
}

/// Adds a picture whose left half is red and whose right half is green.
inline void addColours(mrpt::obs::CObservation3DRangeScan& scan, int width = kWidth, int height = kHeight) {
  scan.hasIntensityImage = true;
  scan.intensityImage = mrpt::img::CImage(width, height, mrpt::img::CH_RGB);
  scan.intensityImage.filledRectangle(0, 0, width / 2 - 1, height - 1, mrpt::img::TColor(200, 10, 20));
  scan.intensityImage.filledRectangle(width / 2, 0, width - 1, height - 1, mrpt::img::TColor(30, 220, 40));
  scan.cameraParamsIntensity = camera(width, height, kFocal * width / kWidth);
}

}  // namespace omnimapper::camera::scans
