#pragma once

#include <omnimapper/query/Verbs.h>

#include "PlaceJson.h"

namespace omnimapper::query {

/// The loop closures that the map rests on, and which of them are forbidden.
Answer answerLoops(const MapToAsk& map, const Request& request);
/// The landmarks that people deleted.
Answer answerDeleted(const MapToAsk& map, const Request& request);

/// A loop closure as JSON.
Json loopJson(const map::ClosedLoop& loop, const map::Corrections& corrections);
/// A deleted landmark as JSON.
Json deletedJson(const map::Corrections::DeletedThing& thing);

}  // namespace omnimapper::query
