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
  std::string ini;            ///< calibration from which this one starts instead of the log's; empty: none
  double start = 0, end = 0;  ///< [s] after the start of the log; end 0: to its end
  int views = 80;             ///< largest number of views
};

struct CalibrationResult {
  base::ExitCode code = base::ExitCode::ok;
  bool is_better = false;  ///< whether held-back views fit better than before
  std::string text;        ///< the summary, one screen
  std::vector<std::string> warnings;
};

/// Refines the calibration of a depth camera from a log and writes calibration.ini, report.txt, summary.json and
/// residuals.svg to a folder. Throws base::Error if the log does not determine it: without pictures or depths, too
/// short, or of a camera at rest. Nothing is written then, nor if it is stopped.
CalibrationResult runCalibration(const CalibrationRequest& request, base::Progress& progress,
                                 const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
