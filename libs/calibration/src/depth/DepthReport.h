#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "DepthCalibration.h"
#include "DepthLog.h"

namespace omnimapper::calibration {

/// The INI section [calibration] with the distortion and the values of the request's INI.
std::string depthIni(const DepthCalibration& calibration, const DepthLog& log, const std::string& title);
/// The report: size of the distortion, its standard deviation over the image, and flatness of planes before and after.
std::string depthReport(const DepthCalibration& calibration, const DepthLog& log, const std::string& title);
std::string depthJson(const DepthCalibration& calibration, const DepthLog& log);
/// Warnings about a calibration that was found.
std::vector<std::string> depthWarnings(const DepthCalibration& calibration, const DepthLog& log);
/// Draws over the image the residuals of held-back planes before and after, the distortion, and its standard deviation.
void drawDistortion(const DepthCalibration& calibration, const DepthLog& log, std::ostream& out);

}  // namespace omnimapper::calibration
