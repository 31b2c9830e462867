#pragma once

#include <string>
#include <vector>

namespace omnimapper::calibration {

/// "a.rawlog + b.rawlog", without folders.
std::string titleOf(const std::vector<std::string>& logs);
/// Throws Error(unwritable_output) where a map is, whose files a calibration's would replace.
void refuseFolderOfMap(const std::string& folder);
/// The line of [calibration] that says whose it is. A label that an INI would not give back, for a stranger's log may
/// hold line breaks and what begins a comment, is left out.
std::string labelLine(const std::string& label);
/// depth_distortion_per_m with its coefficients; empty of none.
std::string distortionLine(const std::vector<double>& coefficients);

}  // namespace omnimapper::calibration
