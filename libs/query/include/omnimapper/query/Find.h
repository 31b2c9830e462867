#pragma once

#include <omnimapper/map/Places.h>
#include <omnimapper/query/TextMatch.h>

#include <string>
#include <vector>

namespace omnimapper::query {

struct FoundPlace {
  const map::Place* place;
  TextMatch match;
};

struct Found {
  /// The best first; all of them fit at the same cost or better than what is not here. Either all are near, or none is.
  std::vector<FoundPlace> places;
  /// Where nothing fits: the names that are least different, the best first.
  std::vector<std::string> closest;

  bool isOnlyNear() const { return !places.empty() && places.front().match.grade == MatchGrade::near; }
};

/// What a place may be asked by: its caption, its label, and the words of those properties that are no measures.
std::vector<std::string> namesOf(const map::Place& place);

/// What is called `text`: all places that a name of theirs fits, and only where there are none those whose name is
/// near. They point into `places`. Throws Error(command_line) if nobody can ask that: an empty or overlong text, one
/// with control characters or that is no UTF-8.
Found find(const std::vector<map::Place>& places, const std::string& text);

}  // namespace omnimapper::query
