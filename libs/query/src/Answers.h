#pragma once

#include <omnimapper/query/Verbs.h>

// What the verbs answer; the table of them is in Verbs.cpp.
namespace omnimapper::query {

Answer answerFind(const MapToAsk& map, const Request& request);
Answer answerNear(const MapToAsk& map, const Request& request);
Answer answerGoal(const MapToAsk& map, const Request& request);
Answer answerList(const MapToAsk& map, const Request& request);

/// The words of a request with blanks between them.
std::string textOf(const Request& request);
/// Throws Error(command_line) for a coordinate [m] that no map has.
void expectInReach(double coordinate);
/// The numbers of an option, or the other ones where it was not given. Throws Error(command_line) for what is not
/// finite.
std::vector<double> numbersOf(const Request& request, const std::string& option, const std::vector<double>& otherwise);

}  // namespace omnimapper::query
