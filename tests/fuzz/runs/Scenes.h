#pragma once

#include <omnimapper/map/MapFile.h>

#include <string>
#include <vector>

#include "LogMutation.h"

namespace omnimapper::fuzz {

/// A short sound log, the INI that fits it, and the program that reads both.
struct Scene {
  std::string name;
  std::string program;  ///< omnimapper-graphslam or omnimapper-perceive
  std::string ini;      ///< path
  Observations log;
};

/// At least one for each INI of ini/, of the simulator of tests and the logs of rawlogs/. `programs` is the folder of
/// the project's programs, `scratch` one for files that are made on the way.
std::vector<Scene> scenes(const std::string& programs, const std::string& scratch);

}  // namespace omnimapper::fuzz
