#pragma once

#include <string>
#include <vector>

namespace omnimapper::query {

/// Other words for a text, that maps may use for the same: singulars of plurals ("chairs": "chair", "shelves":
/// "shelf"), and the class of a thing ("couch": "seat", "fridge": "appliance"). Without the text itself; empty for most
/// texts. English, in lower case.
std::vector<std::string> otherWordsFor(const std::string& text);

}  // namespace omnimapper::query
