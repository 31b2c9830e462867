#pragma once

#include <omnimapper/base/Config.h>

#include <string>
#include <vector>

#include "SensorMounting.h"

namespace omnimapper::check {

/// A line of an INI.
struct MountingLine {
  std::string section, key, value;
  std::string comment;    ///< standard deviation, and what measured the value
  bool is_active = true;  ///< false: it is written as a comment
};

/// The lines that tell the mapper how sensors are mounted, to be read after `config`. Sensors for which `config` has a
/// section keep it. Lines for the sweep are active only if `has_laser_odometry`: no other plugin reads them.
std::vector<MountingLine> mountingLines(const SensorMounting& mounting, const base::Config& config,
                                        bool has_laser_odometry);
/// Why some of what was measured is in no line: whole sentences.
std::vector<std::string> leftOutOfIni(const SensorMounting& mounting, const base::Config& config);
/// The INI; what has two causes is in comments.
std::string mountingIni(const std::vector<MountingLine>& lines, const SensorMounting& mounting,
                        const std::string& title);

}  // namespace omnimapper::check
