#pragma once

#include <ostream>
#include <string>

#include "Calibration.h"
#include "CalibrationLog.h"

namespace omnimapper::calibration {

/// The INI section [calibration] with the values that are determined. If the log's calibration holds, it has only the
/// values of the request's INI.
std::string calibrationIni(const Calibration& calibration, const CalibrationLog& log, const std::string& title);
/// The report: every number with its standard deviation, and the reason for each that is not determined.
std::string reportText(const Calibration& calibration, const CalibrationLog& log, const std::string& title);
std::string summaryJson(const Calibration& calibration, const CalibrationLog& log);
/// Draws the residuals of corners in held-back views over the picture, before and after.
void drawResiduals(const Calibration& calibration, std::ostream& out);

}  // namespace omnimapper::calibration
