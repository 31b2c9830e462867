#pragma once

#include <omnimapper/map/MapFile.h>

#include <string>
#include <vector>

#include "LogMutation.h"

namespace omnimapper::fuzz {

/// A short valid log, an INI that fits it, and the program that reads both.
struct Scene {
  std::string name;
  std::string program;  ///< omnimapper-graphslam or omnimapper-perceive
  std::string ini;      ///< path
  Observations log;
};

/// At least one scene for each INI of ini/, from simulated logs of the tests and the logs of rawlogs/. `programs`:
/// folder of the project's programs. `scratch`: folder for temporary files.
std::vector<Scene> scenes(const std::string& programs, const std::string& scratch);

}  // namespace omnimapper::fuzz
