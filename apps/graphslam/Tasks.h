#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Progress.h>

#include <functional>
#include <optional>

#include "Arguments.h"

/// The tasks of omnimapper-graphslam beside mapping. Each returns the exit code and clears the progress line for its
/// summary.

/// --check: checks logs, or with --live what the sensors send in `[live] check_s`.
int checkLogs(const Arguments& arguments, const omnimapper::base::Config& config,
              std::optional<omnimapper::base::TerminalProgress>& progress, const std::function<bool()>& stop);
/// --record-only: records sensors.
int recordSensors(const Arguments& arguments, const omnimapper::base::Config& config,
                  std::optional<omnimapper::base::TerminalProgress>& progress, const std::function<bool()>& stop);
