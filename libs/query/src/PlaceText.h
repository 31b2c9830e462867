#pragma once

#include <omnimapper/map/Places.h>

#include <string>
#include <vector>

namespace omnimapper::query {

/// A name from a map for a terminal: printable, and of a long one the beginning.
std::string shownName(const std::string& name);
/// `sign "213"`, `wall`.
std::string titleOf(const map::Place& place);

/// Lines of cells, each column as wide as its widest cell; the first line has the heads. A column without any text in
/// it but its head is left out.
std::string alignedTable(const std::vector<std::vector<std::string>>& lines);

/// The heads of cellsOf().
std::vector<std::string> placeHeads();
/// What is known of a place, short: what, id, position, extent, how sure, who saw it how often, when last, whether
/// moved.
std::vector<std::string> cellsOf(const map::Place& place);

/// "2026-11-28 13:05:09", UTC; empty for no stamp.
std::string timeText(base::Stamp stamp);

}  // namespace omnimapper::query
