#pragma once

#include <omnimapper/mapper/EngineOptions.h>
#include <omnimapper/mapper/MappingRun.h>

#include <string>

#include "Engine.h"

namespace omnimapper::mapper {

/// Loads into the engine the saved map that the request continues or localizes in, if it names one. Throws
/// Error(unreadable_input) as readMap(), and if the map has another motion; Error(out_of_range) if it cannot be
/// continued with the session's number.
void loadMapInto(const RunRequest& request, const EngineSettings& settings, const base::Config& config, Engine& engine);

/// Throws Error(command_line) if the request both continues and localizes, or if the outputs of a run that localizes
/// would replace those of a map.
void checkRequest(const RunRequest& request);

}  // namespace omnimapper::mapper
