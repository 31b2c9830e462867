#pragma once

#include <omnimapper/calibration/CalibrationRun.h>
#include <omnimapper/camera/DepthDistortion.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::calibration {

struct DepthRequest {
  std::vector<std::string> logs;
  std::string label;          ///< label of the camera; empty: the first camera with depths
  std::string output;         ///< output folder
  std::string ini;            ///< INI whose [calibration] is applied to the images first; empty: none
  double start = 0, end = 0;  ///< [s] after the start of the log; end 0: to the end of the log
  int images = 90;            ///< largest number of images; every third one only serves to test the result
  int degree = 4;             ///< degree of the polynomial in camera::DepthDistortion
};

/// Estimates the systematic distortion of a depth camera (camera::DepthDistortion) from planes in a log's depth
/// images, and writes calibration.ini, report.txt, summary.json and distortion.svg to a folder. The planes may be any
/// planes at any pose. Throws Error(nothing_to_map), with the remedy, if the log does not determine the distortion,
/// because it has no depth images, too few different ones, too few planes, or planes that leave much of the image
/// uncovered. Throws it also if the planes do not get flatter in the images that only serve to test the result. In
/// these cases nothing is written, nor if `stop` returns true.
CalibrationResult runDepthCalibration(const DepthRequest& request, base::Progress& progress,
                                      const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
