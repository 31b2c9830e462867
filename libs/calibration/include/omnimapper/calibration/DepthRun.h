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
  std::string ini;            ///< with a [calibration] that is applied to the images first; empty: none
  double start = 0, end = 0;  ///< [s] after the log's begin; end 0: to its end
  int images = 90;            ///< at most, of which every third is held back
  int degree = 4;             ///< of the polynomial, perception::DepthDistortion's
};

/// Estimates by how much a depth camera bends planes (perception::DepthDistortion) from the planes of a log's depth
/// images, whatever they are and wherever they lie, and leaves calibration.ini, report.txt, summary.json and
/// distortion.svg in a folder. Throws Error(nothing_to_map), with the remedy, if the log cannot tell it: without depth
/// images, with too few of them that differ, with too few planes, with planes that leave much of the image out; or if
/// planes of the images that were held back get no flatter. Nothing is written then, nor if it is stopped.
CalibrationResult runDepthCalibration(const DepthRequest& request, base::Progress& progress,
                                      const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
