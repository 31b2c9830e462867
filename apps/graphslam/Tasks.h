#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Progress.h>

#include <functional>
#include <optional>

#include "Arguments.h"

/// What omnimapper-graphslam does beside mapping. Each gives the exit code, and frees the line of the progress for its
/// summary.

/// --check, of logs, or with --live of what the sensors send in `[live] check_s`.
int checkLogs(const Arguments& arguments, const omnimapper::base::Config& config,
              std::optional<omnimapper::base::TerminalProgress>& progress, const std::function<bool()>& stop);
/// --record-only.
int recordSensors(const Arguments& arguments, const omnimapper::base::Config& config,
                  std::optional<omnimapper::base::TerminalProgress>& progress, const std::function<bool()>& stop);
