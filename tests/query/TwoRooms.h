#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "HandMadeMap.h"

namespace omnimapper::query {

inline building::Room roomBetween(int id, double min_x, double min_y, double max_x, double max_y) {
  building::Room room;
  room.id = id;
  room.outline = {{min_x, min_y}, {max_x, min_y}, {max_x, max_y}, {min_x, max_y}};
  room.centre = {(min_x + max_x) / 2, (min_y + max_y) / 2};
  room.clearance = std::min(max_x - min_x, max_y - min_y) / 2;
  room.area = (max_x - min_x) * (max_y - min_y);
  return room;
}

inline building::Door doorFrom(int id, int room, int other, double x, double y, double to_x, double to_y) {
  building::Door door;
  door.id = id;
  door.rooms = {room, other};
  door.opening = {{x, y}, {to_x, to_y}};
  door.width = length(door.opening);
  return door;
}

inline map::Place thingAt(double x, double y, const std::string& label) {
  map::Place thing;
  thing.kind = thing.label = label;
  thing.position = {x, y, 0.5};
  thing.extent.points = {{x, y}};
  return thing;
}

/// A kitchen (room 1, x from 0 to 4 m), a room 2 beside it (4.1 to 8 m), both 4 m wide, with door 1 between them at y
/// from 1.5 to 2.5 m; and 118, whose door at (6, 4) was seen from room 2. A column of 0.6 m stands in the middle of
/// room
/// 2. The last pose is (1, 1).
class TwoRooms : public ::testing::Test {
 protected:
  TwoRooms() {
    map::Place sign = signAt(6, 4, "118");
    sign.normal = Eigen::Vector3d(0, -1, 0);
    map_.file = folder_ / "map.omnimap";
    map_.folder = folder_.path();
    map_.id = "0123456789abcdef";
    map_.places = placesOf({sign, thingAt(1, 3, "counter"), thingAt(7, 1, "bed"), thingAt(2, 2.2, "table"),
                            thingAt(3.5, 0.5, "seat"), thingAt(40, 40, "seat")});
    building::Storey storey;
    storey.rooms = {roomBetween(1, 0.1, 0.1, 4, 3.9), roomBetween(2, 4.1, 0.1, 7.9, 3.9)};
    storey.rooms[0].kind = "kitchen";
    storey.rooms[0].kind_confidence = 0.9;
    storey.rooms[0].why = {{building::NameEvidence::Source::contents, "kitchen by 1 counter", 0.9}};
    storey.rooms[0].neighbours = {2};
    storey.rooms[1].neighbours = {1};
    storey.doors = {doorFrom(1, 1, 2, 4.05, 1.5, 4.05, 2.5)};
    building::UnseenRoom unseen;
    unseen.name = "118";
    unseen.door = {6, 4};
    unseen.seen_from = 2;
    unseen.confidence = 0.9;
    storey.unseen = {unseen};
    storey.next_room = 3;
    storey.next_door = 2;
    map_.rooms = storey;
    std::vector<std::string> rows(40, "#" + std::string(78, '.') + "#");
    rows.front() = rows.back() = std::string(80, '#');
    for (int row = 0; row < 40; ++row)
      if (row < 15 || row >= 25) rows[row][40] = '#';
    for (int row = 17; row < 23; ++row)
      for (int column = 57; column < 63; ++column) rows[row][column] = '#';
    putGrid(folder_.path(), rows, "0.1");
  }
  Answer ask(const std::string& verb, const std::vector<std::string>& words) const {
    for (const auto& each : verbs())
      if (each.name == verb) return each.answer(map_, {words, {}});
    throw std::logic_error(verb);
  }
  nlohmann::json asked(const std::string& verb, const std::vector<std::string>& words) const {
    return nlohmann::json::parse(ask(verb, words).json);
  }
  static bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

  testing::ScratchFolder folder_;
  MapToAsk map_;
};

}  // namespace omnimapper::query
