#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/base/OutputFolder.h>
#include <omnimapper/calibration/CalibrationRun.h>

#include "Calibration.h"
#include "CalibrationLog.h"
#include "CalibrationReport.h"
#include "Outputs.h"

namespace omnimapper::calibration {

namespace {

std::vector<std::string> warningsOf(const CalibrationLog& log) {
  std::vector<std::string> all;
  if (!log.report.message.empty()) all.push_back(log.report.message);
  for (auto& sentence : log.report.unusableText()) all.push_back(std::move(sentence));
  if (log.left_out > 0)
    all.push_back(base::counted(log.left_out, "image") + " of the camera left out, the first because " +
                  log.why_left_out);
  constexpr double kMuch = 0.2;
  if (static_cast<double>(log.lost) > kMuch * static_cast<double>(log.images))
    all.push_back("tracking of the camera was lost in " + std::to_string(log.lost) + " of " +
                  std::to_string(log.images) + " images: move it more slowly, in front of objects with corners");
  return all;
}

}  // namespace

CalibrationResult runCalibration(const CalibrationRequest& request, base::Progress& progress,
                                 const std::function<bool()>& stop) {
  refuseFolderOfMap(request.output);
  const base::InputsKept inputs_kept(request.logs);
  base::OutputFolder folder(request.output);
  folder.open();
  const auto log = readCalibrationLog(request, progress, stop);
  const auto title = titleOf(request.logs);
  Calibration calibration;
  try {
    calibration = calibrate(log.views, log.camera, log.spans, progress, stop);
  } catch (const base::Error& error) {
    throw base::Error(error.code(), title + ": " + error.what());
  }
  CalibrationResult result;
  result.code = log.report.exitCode();
  result.is_better = calibration.is_better;
  result.text = reportText(calibration, log, title);
  result.warnings = warningsOf(log);
  const auto write = [&](const std::string& name, const std::string& text) {
    base::writeFile(folder.staging() + "/" + name, [&](std::ostream& out) { out << text; });
  };
  write("calibration.ini", calibrationIni(calibration, log, title));
  write("report.txt", result.text);
  write("summary.json", summaryJson(calibration, log));
  base::writeFile(folder.staging() + "/residuals.svg", [&](std::ostream& out) { drawResiduals(calibration, out); });
  folder.commit();
  return result;
}

}  // namespace omnimapper::calibration
