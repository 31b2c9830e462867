#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::calibration {

struct CalibrationRequest {
  std::vector<std::string> logs;
  std::string label;          ///< of the camera; empty: the first with depths and a picture
  std::string output;         ///< folder
  std::string ini;            ///< a calibration that counts over the log's, from which this one starts; empty: none
  double start = 0, end = 0;  ///< [s] after the log's begin; end 0: to its end
  int views = 80;             ///< at most
};

struct CalibrationResult {
  base::ExitCode code = base::ExitCode::ok;
  bool is_better = false;  ///< whether calibration.ini tells any number
  std::string text;        ///< the summary, one screen
  std::vector<std::string> warnings;
};

/// Refines the calibration of a camera with depths from a log of it, and leaves calibration.ini, report.txt,
/// summary.json and residuals.svg in a folder. Throws base::Error if the log cannot tell it: without pictures or
/// depths, too short, of a camera at rest. Nothing is written then, nor if it is stopped.
CalibrationResult runCalibration(const CalibrationRequest& request, base::Progress& progress,
                                 const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
