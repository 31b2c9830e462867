#pragma once

#include <omnimapper/map/Places.h>

#include <string>
#include <vector>

namespace omnimapper::query {

/// A name from a map for a terminal: printable, and shortened if it is long.
std::string shownName(const std::string& name);
/// "2.50 -1.00" [m].
std::string pointText(const Eigen::Vector2d& point);
/// `sign "213"`, `wall`.
std::string titleOf(const map::Place& place);

/// A table of lines of cells; the first line has the headings. Each column is as wide as its widest cell, and columns
/// with only a heading are left out.
std::string alignedTable(const std::vector<std::vector<std::string>>& lines);

/// The headings of cellsOf().
std::vector<std::string> placeHeads();
/// A short description of a place: name, id, position, extent, standard deviation, number of measurements by sensor,
/// time of the last one, and whether it has moved.
std::vector<std::string> cellsOf(const map::Place& place);

/// "2026-11-28 13:05:09", UTC; empty for no stamp.
std::string timeText(base::Stamp stamp);

}  // namespace omnimapper::query
