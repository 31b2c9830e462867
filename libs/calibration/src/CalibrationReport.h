#pragma once

#include <ostream>
#include <string>

#include "Calibration.h"
#include "CalibrationLog.h"

namespace omnimapper::calibration {

/// [calibration] of what is determined; without any number where the log's values hold.
std::string calibrationIni(const Calibration& calibration, const CalibrationLog& log, const std::string& title);
/// Every number with its standard deviation, and what is not determined, with the reason.
std::string reportText(const Calibration& calibration, const CalibrationLog& log, const std::string& title);
std::string summaryJson(const Calibration& calibration, const CalibrationLog& log);
/// By how much the corners of held-back views miss over the picture, before and after.
void drawResiduals(const Calibration& calibration, std::ostream& out);

}  // namespace omnimapper::calibration
