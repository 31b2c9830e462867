#pragma once

#include <omnimapper/calibration/CalibrationRun.h>
#include <omnimapper/source/SourceReport.h>

#include <string>
#include <vector>

#include "Bundle.h"
#include "CalibrationView.h"

namespace omnimapper::calibration {

/// The data of a log from which its camera is calibrated.
struct CalibrationLog {
  DepthCamera camera;
  std::string label;  ///< of the camera
  std::vector<CalibrationView> views;
  std::vector<MetricSpan> spans;         ///< from wheels or given poses
  bool are_wheels = false;               ///< the spans are from wheels, whose scale is uncertain
  bool is_corrected = false;             ///< the calibration starts from an INI's instead of the log's
  double corrected_scale = 1;            ///< of depths, in that INI
  std::vector<double> depth_distortion;  ///< [1/m] of that INI; it stays as it is
  bool is_part = false;                  ///< the log was not read to its end, because there are enough views
  std::size_t images = 0, lost = 0, left_out = 0;
  std::string why_left_out;     ///< reason for the first image
  double travel = 0, turn = 0;  ///< [m] [rad] of the camera
  source::SourceReport report;
};

/// Throws Error(nothing_to_map) if the log has no usable images, and Error(interrupted).
CalibrationLog readCalibrationLog(const CalibrationRequest& request, base::Progress& progress,
                                  const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
