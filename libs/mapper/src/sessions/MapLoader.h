#pragma once

#include <omnimapper/mapper/MappingRun.h>
#include <omnimapper/mapper/SessionOptions.h>

#include <string>

#include "Engine.h"

namespace omnimapper::mapper {

/// Loads into the engine the saved map that the request continues or localizes in, if it names one. Throws
/// Error(unreadable_input) as readMap(), and if the map has another motion.
void loadMapInto(const RunRequest& request, const SessionOptions& session, const base::Config& config, Motion motion,
                 Engine& engine);

/// Throws Error(command_line) if the request both continues and localizes, or if the outputs of a run that localizes
/// would replace those of a map.
void checkRequest(const RunRequest& request);

}  // namespace omnimapper::mapper
