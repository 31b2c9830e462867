#pragma once

#include <omnimapper/query/Verbs.h>

#include <Eigen/Core>
#include <string>
#include <vector>

// The functions that answer the verbs; the table of verbs is in Verbs.cpp.
namespace omnimapper::query {

Answer answerFind(const MapToAsk& map, const Request& request);
Answer answerNear(const MapToAsk& map, const Request& request);
Answer answerGoal(const MapToAsk& map, const Request& request);
Answer answerList(const MapToAsk& map, const Request& request);
Answer answerLayers(const MapToAsk& map, const Request& request);

/// A table of at most 40 lines of places; a line says how many more there are.
std::string tableOf(std::vector<std::vector<std::string>> lines);
/// The point that the first two words of a request give [m]. Throws Error(command_line) if they are no coordinates.
Eigen::Vector2d pointOf(const Request& request);
/// The words of a request, separated by blanks.
std::string textOf(const Request& request);
/// Throws Error(command_line) if no map can have this coordinate [m].
void expectInReach(double coordinate);
/// The numbers of an option, or `otherwise` if it was not given. Throws Error(command_line) if one is not finite.
std::vector<double> numbersOf(const Request& request, const std::string& option, const std::vector<double>& otherwise);

}  // namespace omnimapper::query
