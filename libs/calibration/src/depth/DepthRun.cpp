#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/OutputFolder.h>
#include <omnimapper/calibration/DepthRun.h>

#include "../Outputs.h"
#include "DepthCalibration.h"
#include "DepthLog.h"
#include "DepthReport.h"

namespace omnimapper::calibration {

CalibrationResult runDepthCalibration(const DepthRequest& request, base::Progress& progress,
                                      const std::function<bool()>& stop) {
  refuseFolderOfMap(request.output);
  const base::InputsKept inputs_kept(request.logs);
  base::OutputFolder folder(request.output);
  folder.open();
  const auto log = readDepthLog(request, progress, stop);
  const auto title = titleOf(request.logs);
  DepthCalibration calibration;
  try {
    calibration = calibrateDepth(log.images, request.degree, progress, stop);
  } catch (const base::Error& error) {
    throw base::Error(error.code(), title + ": " + error.what());
  }
  CalibrationResult result;
  result.code = log.report.exitCode();
  result.is_better = true;
  result.text = depthReport(calibration, log, title);
  result.warnings = depthWarnings(calibration, log);
  const auto write = [&](const std::string& name, const auto& writer) {
    base::writeFile(folder.staging() + "/" + name, writer);
  };
  write("calibration.ini", [&](std::ostream& out) { out << depthIni(calibration, log, title); });
  write("report.txt", [&](std::ostream& out) { out << result.text; });
  write("summary.json", [&](std::ostream& out) { out << depthJson(calibration, log); });
  write("distortion.svg", [&](std::ostream& out) { drawDistortion(calibration, log, out); });
  folder.commit();
  return result;
}

}  // namespace omnimapper::calibration
