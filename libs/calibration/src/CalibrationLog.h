#pragma once

#include <omnimapper/calibration/CalibrationRun.h>
#include <omnimapper/source/SourceReport.h>

#include <string>
#include <vector>

#include "Bundle.h"
#include "CalibrationView.h"

namespace omnimapper::calibration {

/// What of a log can calibrate its camera.
struct CalibrationLog {
  DepthCamera camera;
  std::string label;  ///< of the camera
  std::vector<CalibrationView> views;
  std::vector<MetricSpan> spans;         ///< of wheels or given poses
  bool are_wheels = false;               ///< spans are of wheels, whose own scale is uncertain
  bool is_corrected = false;             ///< by an INI, from which the calibration starts
  double corrected_scale = 1;            ///< of depths, by that INI
  std::vector<double> depth_distortion;  ///< by that INI [1/m]; it stays as it is
  bool is_part = false;                  ///< the log goes on, but there are views enough
  std::size_t images = 0, lost = 0, left_out = 0;
  std::string why_left_out;     ///< of the first image that was
  double travel = 0, turn = 0;  ///< [m] [rad] of the camera
  source::SourceReport report;
};

/// Throws Error(nothing_to_map) where nothing can be made of it, and Error(interrupted).
CalibrationLog readCalibrationLog(const CalibrationRequest& request, base::Progress& progress,
                                  const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
