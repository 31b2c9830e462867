#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Progress.h>

#include <functional>
#include <optional>

#include "MappingArguments.h"

/// The tasks of omnimapper-graphslam other than mapping. Each removes the progress line before it prints its summary,
/// and returns the exit code.

/// --check: checks logs, or with --live what the sensors send during `[live] check_s`.
int checkLogs(const Arguments& arguments, const omnimapper::base::Config& config,
              std::optional<omnimapper::base::TerminalProgress>& progress, const std::function<bool()>& stop);
/// --record-only: records the sensors without mapping.
int recordSensors(const Arguments& arguments, const omnimapper::base::Config& config,
                  std::optional<omnimapper::base::TerminalProgress>& progress, const std::function<bool()>& stop);
