#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

/// How well segments of a grid agree with true rooms. Rooms and segments are numbers of cells; 0 is none.
namespace omnimapper::bench {

using CellNumbers = std::vector<std::int32_t>;

/// Numbers of cells of rooms, of segments and of what they have in common.
struct CellCounts {
  CellCounts(const CellNumbers& truth, const CellNumbers& segments, const std::vector<char>& counts) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (counts[i] == 0) continue;
      ++all;
      if (truth[i] != 0) ++rooms[truth[i]];
      if (segments[i] != 0) ++this->segments[segments[i]];
      if (truth[i] != 0 && segments[i] != 0) ++common[{truth[i], segments[i]}];
    }
  }
  double all = 0;
  std::map<int, double> rooms, segments;
  std::map<std::pair<int, int>, double> common;
};

struct PlanScore {
  double mcc = 0;  ///< mean Matthews correlation coefficient of rooms and unmatched segments
  double precision = 0, recall = 0;
  int rooms = 0, unmatched = 0;
};

/// Rooms and segments are matched one to one, the pair with the largest coefficient first. Precision: mean share of a
/// segment that is in one room; recall: mean share of a room that is in one segment.
inline PlanScore scoreOfPlan(const CellCounts& counts) {
  std::vector<std::tuple<double, int, int>> pairs;
  std::map<int, double> in_room, in_segment;
  for (const auto& [ids, both] : counts.common) {
    const double room = counts.rooms.at(ids.first), segment = counts.segments.at(ids.second);
    const double fp = segment - both, fn = room - both, tn = counts.all - both - fp - fn;
    const double product = segment * room * (tn + fp) * (tn + fn);
    pairs.emplace_back(product > 0 ? -(both * tn - fp * fn) / std::sqrt(product) : 0, ids.first, ids.second);
    in_room[ids.second] = std::max(in_room[ids.second], both / segment);
    in_segment[ids.first] = std::max(in_segment[ids.first], both / room);
  }
  std::sort(pairs.begin(), pairs.end());
  std::set<int> rooms, segments;
  double sum = 0;
  for (const auto& [negative, room, segment] : pairs) {
    if (rooms.count(room) > 0 || segments.count(segment) > 0) continue;
    rooms.insert(room);
    segments.insert(segment);
    sum -= negative;
  }
  PlanScore score;
  score.rooms = static_cast<int>(counts.rooms.size());
  score.unmatched = static_cast<int>(counts.segments.size() - segments.size());
  score.mcc = sum / std::max(1, score.rooms + score.unmatched);
  for (const auto& [segment, share] : in_room) score.precision += share / static_cast<double>(counts.segments.size());
  for (const auto& [room, share] : in_segment) score.recall += share / static_cast<double>(counts.rooms.size());
  return score;
}

/// Number of rooms that a segment covers with an intersection over union of at least `least`.
inline int roomsFound(const CellCounts& counts, double least) {
  std::set<int> found;
  for (const auto& [ids, both] : counts.common)
    if (both >= least * (counts.rooms.at(ids.first) + counts.segments.at(ids.second) - both)) found.insert(ids.first);
  return static_cast<int>(found.size());
}

}  // namespace omnimapper::bench
