#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "RgbdFolder.h"

namespace omnimapper::source {

/// Content of a folder of RGB-D images, in whatever form.
struct RgbdFolderContent {
  std::vector<RgbdPair> pairs;  ///< in order of stamps
  std::vector<std::pair<base::Stamp, geometry::Se3>> world_from_optical;
  std::string usual_intrinsics;  ///< empty: unknown
  double usual_depth_units = 5000;
};

/// Throws Error(unreadable_input).
RgbdFolderContent readRgbdFolder(const std::filesystem::path& folder, const RgbdFolderOptions& options);

}  // namespace omnimapper::source
