#pragma once

#include <omnimapper/query/Verbs.h>

// The functions that answer the verbs about rooms; the table of verbs is in Verbs.cpp.
namespace omnimapper::query {

Answer answerRooms(const MapToAsk& map, const Request& request);
Answer answerWhere(const MapToAsk& map, const Request& request);
Answer answerIn(const MapToAsk& map, const Request& request);
Answer answerWhich(const MapToAsk& map, const Request& request);
Answer answerPath(const MapToAsk& map, const Request& request);
Answer answerBetween(const MapToAsk& map, const Request& request);

}  // namespace omnimapper::query
