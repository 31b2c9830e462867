#pragma once

#include <omnimapper/query/Find.h>

#include <string>
#include <vector>

#include "PlaceJson.h"

namespace omnimapper::query {

/// "nothing is called 'xyz', nor nearly so; closest: 213, 214": a whole line.
std::string nothingCalled(const std::string& text, const Found& found);
/// Says whether what was found is called so or only nearly so, and of how many it is: a whole line.
std::string foundLine(const std::string& text, const Found& found);
/// The places with how they match.
Json matchesJson(const Found& found);
/// Labels with commas between them.
std::string namesText(const std::vector<map::Place>& places);

}  // namespace omnimapper::query
