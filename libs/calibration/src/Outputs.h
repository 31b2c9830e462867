#pragma once

#include <string>
#include <vector>

namespace omnimapper::calibration {

/// "a.rawlog + b.rawlog", without folders.
std::string titleOf(const std::vector<std::string>& logs);
/// Throws Error(unwritable_output) if the folder holds a map, because a calibration would replace its files.
void refuseFolderOfMap(const std::string& folder);
/// The line of [calibration] with the camera's label. A label that cannot be read back from an INI is left out: a log
/// from an untrusted source may have line breaks or the start of a comment in it.
std::string labelLine(const std::string& label);
/// The line with the key depth_distortion_per_m; empty if there are no coefficients.
std::string distortionLine(const std::vector<double>& coefficients);

}  // namespace omnimapper::calibration
