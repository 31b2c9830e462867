#pragma once

#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/mapper/SessionOptions.h>

#include <string>

#include "Engine.h"

namespace omnimapper::mapper {

/// Gives the engine the saved map that the request goes on from or localizes in, if it names one. `ini` names the INI
/// in errors. Throws Error(unreadable_input) as readMap(), and if the map is not of that motion.
void loadMapInto(const RunRequest& request, const SessionOptions& session, const base::Config& config, Motion motion,
                 Engine& engine);

/// Throws Error(command_line) if both are asked for, or if the outputs of a run that localizes would take the place of
/// those of a map.
void checkRequest(const RunRequest& request);

}  // namespace omnimapper::mapper
