#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::calibration {

struct CalibrationRequest {
  std::vector<std::string> logs;
  std::string label;          ///< label of the camera; empty: the first camera with depths and a picture
  std::string output;         ///< output folder
  std::string ini;            ///< INI whose calibration is refined; empty: the log's calibration is refined
  double start = 0, end = 0;  ///< [s] after the start of the log; end 0: to the end of the log
  int views = 80;             ///< largest number of images that are used
};

struct CalibrationResult {
  base::ExitCode code = base::ExitCode::ok;
  bool is_better = false;  ///< whether images that were not used for the estimate fit better than before
  std::string text;        ///< summary for one screen
  std::vector<std::string> warnings;
};

/// Refines the calibration of a depth camera from a log and writes calibration.ini, report.txt, summary.json and
/// residuals.svg to a folder. Throws base::Error if the log does not determine the calibration, because it has no
/// pictures or no depths, is too short, or the camera was at rest. In that case nothing is written, nor if `stop`
/// returns true.
CalibrationResult runCalibration(const CalibrationRequest& request, base::Progress& progress,
                                 const std::function<bool()>& stop);

}  // namespace omnimapper::calibration
