#include "Outputs.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace omnimapper::calibration {

std::string titleOf(const std::vector<std::string>& logs) {
  std::string title;
  for (const auto& log : logs) title += (title.empty() ? "" : " + ") + log.substr(log.find_last_of('/') + 1);
  return title;
}

void refuseFolderOfMap(const std::string& folder) {
  std::error_code none;
  if (std::filesystem::exists(folder + "/map.omnimap", none))
    throw base::Error(base::ExitCode::unwritable_output,
                      folder + ": a map is in this folder, and a calibration would replace it; use another folder");
}

std::string labelLine(const std::string& label) {
  const bool is_plain = std::all_of(label.begin(), label.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/' || c == ':';
  });
  return (is_plain ? "label = " + label : "; for every camera: the label of this one cannot be written in an INI") +
         "\n";
}

std::string distortionLine(const std::vector<double>& coefficients) {
  if (coefficients.empty()) return "";
  std::string line = "depth_distortion_per_m =";
  for (std::size_t i = 0; i < coefficients.size(); ++i) line += (i == 0 ? " " : ", ") + base::brief(coefficients[i], 5);
  return line + "\n";
}

}  // namespace omnimapper::calibration
