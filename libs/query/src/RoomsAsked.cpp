#include <omnimapper/base/Error.h>
#include <omnimapper/query/RoomsAsked.h>

#include <algorithm>
#include <string_view>
#include <tuple>

namespace omnimapper::query {

namespace {

using building::Room;
using building::Storey;
using Eigen::Vector2d;

std::vector<std::string> namesOf(const Room& room) {
  std::vector<std::string> names{"room " + std::to_string(room.id)};
  if (!room.name.empty()) names.push_back(room.name);
  if (!room.kind.empty() && room.kind_confidence >= building::kSureKind) names.push_back(room.kind);
  return names;
}

}  // namespace

const Storey& roomsOf(const MapToAsk& map) {
  if (!map.rooms)
    throw base::Error(base::ExitCode::unreadable_input,
                      map.file +
                          ": has no rooms: map its log again with a RoomsPlugin in [mapper] measurement_plugins, as in "
                          "ini/laser2d.ini, or continue it. Rooms need a level 2D laser.");
  return *map.rooms;
}

std::vector<FoundRoom> findRooms(const MapToAsk& map, const std::string& text) {
  std::vector<FoundRoom> all;
  if (!map.rooms) return all;
  // "the kitchen" and "room 213" are the kitchen and 213.
  std::vector<AskedText> asked{AskedText(text)};
  for (const std::string_view before : {"the ", "room ", "the room "})
    if (text.size() > before.size() && text.compare(0, before.size(), before) == 0)
      asked.emplace_back(text.substr(before.size()));
  const auto match = [&](const std::vector<std::string>& names) {
    TextMatch best{MatchGrade::near, 2, ""};
    for (const auto& each : asked)
      if (const TextMatch other = bestOf(each, names);
          std::tie(other.grade, other.cost) < std::tie(best.grade, best.cost))
        best = other;
    return best;
  };
  for (const Room& room : map.rooms->rooms) all.push_back({&room, nullptr, match(namesOf(room))});
  for (const auto& unseen : map.rooms->unseen) all.push_back({nullptr, &unseen, match({unseen.name})});
  std::stable_sort(all.begin(), all.end(), [](const FoundRoom& a, const FoundRoom& b) {
    return std::tie(a.match.grade, a.match.cost) < std::tie(b.match.grade, b.match.cost);
  });
  if (all.empty()) return all;
  const TextMatch best = all.front().match;
  const auto fits = [&](const FoundRoom& room) {
    return best.grade == MatchGrade::near ? room.match.cost <= std::min(AskedText::kNear, best.cost)
                                          : room.match.grade == best.grade;
  };
  all.erase(std::find_if_not(all.begin(), all.end(), fits), all.end());
  return all;
}

const Room* roomOf(const Storey& storey, const map::Place& place) {
  std::optional<Vector2d> free_side;
  if (place.normal && place.normal->head<2>().norm() > 0.5) {
    free_side = place.normal->head<2>();
  } else if (place.seen_from) {
    free_side = place.seen_from->head<2>();
  }
  return roomOfThing(storey, place.position.head<2>(), free_side);
}

}  // namespace omnimapper::query
