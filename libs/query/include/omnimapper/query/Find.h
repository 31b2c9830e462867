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
  /// The best match first; each match is at least as good as any that is not listed. Either all of them are near
  /// matches, or none is.
  std::vector<FoundPlace> places;
  /// The most similar names, the best first, if nothing fits.
  std::vector<std::string> closest;

  bool isOnlyNear() const { return !places.empty() && places.front().match.grade == MatchGrade::near; }
};

/// The names by which a place can be found: its caption, its label, and the values of those properties that are texts
/// and not measures.
std::vector<std::string> namesOf(const map::Place& place);

/// Whether an id, as it is printed ("0:111"), is that of the place or of a face of the thing that it stands for.
bool hasId(const map::Place& place, const std::string& id);

/// The places called `text`: the one of that id ("0:111"), which may be that of a face of a thing, or all places with a
/// name that fits, or if there are none, those with a similar name. The result points into `places`. Throws
/// Error(command_line) for a text that is empty, too long or not UTF-8, or has control characters.
Found find(const std::vector<map::Place>& places, const std::string& text);

}  // namespace omnimapper::query
