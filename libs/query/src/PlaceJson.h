#pragma once

#include <omnimapper/map/Places.h>
#include <omnimapper/query/MapToAsk.h>

#include <nlohmann/json.hpp>
#include <string>

namespace omnimapper::query {

using Json = nlohmann::ordered_json;

/// All data of a place. Lengths [m], angles [rad], times ISO 8601 in UTC; null if not known. `brief`: only what it is
/// called, where it is, and whether it is still there.
Json jsonOf(const map::Place& place, bool brief = false);

/// ISO 8601 in UTC: "2023-11-14T22:22:17Z"; null for no stamp.
Json timeJson(base::Stamp stamp);

/// A document that begins with the verb, the map, its frame and its age, to which the query and the answer are added.
Json answerTo(const std::string& verb, const MapToAsk& map);

/// The document as ASCII text with one line feed at the end.
std::string textOf(const Json& document);

}  // namespace omnimapper::query
