#pragma once

#include <omnimapper/query/Find.h>

#include <string>
#include <vector>

#include "PlaceJson.h"

namespace omnimapper::query {

/// "nothing is called 'xyz' or similarly; closest: '213', '214'", with a line feed.
std::string nothingCalled(const std::string& text, const Found& found);
/// A line that says whether the name fits or is only near, and how many landmarks were found.
std::string foundLine(const std::string& text, const Found& found);
/// The places that were found, how well they match, and their rooms, if the map has any.
Json matchesJson(const Found& found, const MapToAsk& map, bool brief = false);
/// The labels of the places, separated by commas.
std::string namesText(const std::vector<map::Place>& places);

}  // namespace omnimapper::query
