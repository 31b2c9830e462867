#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "DepthCalibration.h"
#include "DepthLog.h"

namespace omnimapper::calibration {

/// [calibration] with the distortion, and with what an INI told before.
std::string depthIni(const DepthCalibration& calibration, const DepthLog& log, const std::string& title);
/// How large the distortion is, how well it is known where, and how flat planes are before and after.
std::string depthReport(const DepthCalibration& calibration, const DepthLog& log, const std::string& title);
std::string depthJson(const DepthCalibration& calibration, const DepthLog& log);
/// What is to be known of a calibration that was found all the same.
std::vector<std::string> depthWarnings(const DepthCalibration& calibration, const DepthLog& log);
/// The misses of planes held back over the image, before and after, the distortion and its standard deviation.
void drawDistortion(const DepthCalibration& calibration, const DepthLog& log, std::ostream& out);

}  // namespace omnimapper::calibration
