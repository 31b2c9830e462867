#pragma once

#include <cstdio>
#include <string>

namespace omnimapper::sim {

/// Name of an image file of measurement k, such as "labels/camera_000012.png".
inline std::string frameName(const std::string& folder, const std::string& label, int k) {
  char number[16];
  std::snprintf(number, sizeof number, "%06d", k);
  return folder + "/" + label + "_" + number + ".png";
}

}  // namespace omnimapper::sim
