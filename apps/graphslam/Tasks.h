#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/mapper/MappingRun.h>

#include <functional>
#include <optional>

#include "MappingArguments.h"

/// The INIs of the command line with its settings.
omnimapper::base::Config readConfig(const Arguments& arguments);

/// Maps observations of logs, which are checked beside, or of sensors.
omnimapper::mapper::RunResult mapObservations(Arguments& arguments, const omnimapper::base::Config& config,
                                              omnimapper::base::Progress& progress, const std::function<bool()>& stop);

/// The other tasks of omnimapper-graphslam. Each removes the progress line before it prints its summary,
/// and returns the exit code.

/// --check: checks logs, or with --live what the sensors send during `[live] check_s`.
int checkLogs(const Arguments& arguments, const omnimapper::base::Config& config,
              std::optional<omnimapper::base::TerminalProgress>& progress, const std::function<bool()>& stop);
/// --record-only: records the sensors without mapping.
int recordSensors(const Arguments& arguments, const omnimapper::base::Config& config,
                  std::optional<omnimapper::base::TerminalProgress>& progress, const std::function<bool()>& stop);
