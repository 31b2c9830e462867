#pragma once

#include <omnimapper/calibration/CalibrationRun.h>
#include <omnimapper/perception/DepthDistortion.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::calibration {

struct DepthRequest {
  std::vector<std::string> logs;
  std::string label;          ///< of the camera; empty: the first with depths
  std::string output;         ///< folder
  std::string ini;            ///< INI whose [calibration] is applied to the images first; empty: none
  double start = 0, end = 0;  ///< [s] after the start of the log; end 0: to its end
  int images = 90;            ///< largest number of images, of which every third is held back
  int degree = 4;             ///< of the polynomial of perception::DepthDistortion
};

/// Estimates the systematic distortion of a depth camera (perception::DepthDistortion) from planes in a log's depth
/// images, which may be any planes at any pose, and writes calibration.ini, report.txt, summary.json and distortion.svg
/// to a folder. Throws Error(nothing_to_map), with the remedy, if the log does not determine it: it has no depth
/// images, too few different ones, too few planes, or planes that leave much of the image uncovered; or if the planes
/// of held-back images get no flatter. Nothing is written then, nor if it is stopped.
CalibrationResult runDepthCalibration(const DepthRequest& request, base::Progress& progress,
                                      const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
