#pragma once

#include <omnimapper/query/Verbs.h>

// Answers about things on tables and other surfaces; the table of verbs is in Verbs.cpp.
namespace omnimapper::query {

/// What was seen on the surfaces of that name, what is gone from them, and when somebody looked last.
Answer answerLooked(const MapToAsk& map, const Request& request);
/// The landmarks of that name which stand on a surface called `on`.
Answer answerFindOn(const MapToAsk& map, const Request& request, const std::string& on);

}  // namespace omnimapper::query
