#include <algorithm>
#include <cmath>

#include "PlaceGenerators.h"

namespace omnimapper::sim {

using Eigen::Vector2d;

void furnishOffice(Arrangement& place, const std::string& room, int desks) {
  for (int i = 0; i < desks; ++i) {
    const auto desk = place.alongWall(room, "desk", i % 2 == 0 ? Along::corner : Along::anywhere, 0.75);
    if (!desk) break;
    place.beside(*desk, "office_chair", {-0.2, -0.55}, M_PI + place.random.uniform(-0.5, 0.5));
    place.objectsOn(*desk, "top", 3, {"laptop", "cup", "book", "lamp", "box", "can"});
  }
  place.alongWall(room, "filing_cabinet", Along::corner, 0.4);
  if (const auto shelf = place.alongWall(room, "shelf", Along::corner, 0.4)) {
    place.objectsOn(*shelf, "board_3", 2, {"book", "box"});
    place.objectsOn(*shelf, "board_4", 1, {"ball", "box", "pot"});
  }
  place.alongWall(room, "bookcase", Along::anywhere, 0.4);
  place.alongWall(room, "bin", Along::corner, 0);
  place.scatter(room, 0.08);
  place.postersIn(room, 2);
}

void furnishKitchenette(Arrangement& place, const std::string& room) {
  FurniturePlan run;
  run.length = 2.4;
  if (const auto counter = place.alongWall(room, "counter", Along::middle, 0.8, run)) {
    place.objectsOn(*counter, "top", 6, {"pot", "bottle", "can", "bowl", "cup", "plate"});
    place.beside(*counter, "fridge", {1.2 + 0.32, -0.02}, 0);
  }
  if (const auto table = place.inMiddle(room, "round_table")) {
    place.chairsAround(*table, "chair", 2);
    place.objectsOn(*table, "top", 2, {"cup", "bowl", "bottle"});
  }
  place.alongWall(room, "bin", Along::corner, 0);
  place.postersIn(room, 2);
}

void furnishLaboratory(Arrangement& place, const std::string& room) {
  const double area = doubleArea(place.roomNamed(room).outline) / 2;
  const int stations = std::max(2, static_cast<int>(area / 14));
  for (int i = 0; i < stations; ++i) {
    const bool in_middle = i % 3 == 0;
    const auto bench =
        in_middle ? place.inMiddle(room, "workbench", {}, 5) : place.alongWall(room, "workbench", Along::anywhere, 0.6);
    if (!bench) continue;
    place.objectsOn(*bench, "top", 4, {"box", "can", "bottle", "lamp", "brick", "cone", "prism", "laptop"});
    if (place.random.chance(0.6))
      place.beside(*bench, "office_chair", {0.3, -0.6}, M_PI + place.random.uniform(-0.6, 0.6));
  }
  for (int i = 0; i < stations / 2; ++i) {
    if (const auto rack = place.alongWall(room, "rack", Along::anywhere, 0.4)) {
      place.objectsOn(*rack, "board_2", 2, {"box", "can", "pot"});
      place.objectsOn(*rack, "board_3", 2, {"box", "bottle", "ball"});
    }
  }
  for (int i = 0; i < stations / 3; ++i) place.inMiddle(room, "machine", {}, 5);
  place.scatter(room, 0.16);
  place.postersIn(room, 3);
}

namespace {

// Invented names of people and uses of rooms for signs.
const char* const kPeople[] = {"Carol Hart",  "Ned Alvarez", "Ilse Brandt",  "Tom Okafor",  "Mina Sato",
                               "Paul Winter", "Rosa Lind",   "Omar Haddad",  "Grete Falk",  "Ivan Petrov",
                               "Lucy Marsh",  "Henri Blanc", "Asha Verma",   "Karl Nyberg", "Ella Stone",
                               "Jonas Weber", "Nora Quinn",  "Felix Moreau", "Sofia Rossi", "Aled Price"};
const char* const kUses[] = {"Storage", "Printer",  "Server Room", "Meeting",
                             "Seminar", "Workshop", "Copy Room",   "Archive"};

}  // namespace

void addDoorsAlong(Arrangement& place, const std::string& corridor, double spacing, int& number) {
  const auto room = std::find_if(place.plan.rooms.begin(), place.plan.rooms.end(),
                                 [&](const RoomPlan& r) { return r.name == corridor; });
  const Vector2d low = room->outline[0], high = room->outline[2], size = high - low;
  const int axis = size.x() > size.y() ? 0 : 1;
  const double margin = size[1 - axis] + 0.5;  // beyond the corners of a ring
  for (double along = margin; along < size[axis] - margin; along += spacing * place.random.uniform(0.8, 1.2)) {
    for (const bool at_high : {false, true}) {
      if (place.random.chance(0.15)) continue;
      Vector2d at = at_high ? high : low;
      at[axis] = low[axis] + along + (at_high ? place.random.uniform(-0.3, 0.3) : 0);
      OpeningPlan& door = place.opening(OpeningPlan::Kind::door, corridor, "outside", at);
      door.leaf = OpeningPlan::Leaf::closed;
      door.name = "door_" + std::to_string(++number);
    }
  }
}

void addSigns(Arrangement& place) {
  const auto& rooms = place.plan.rooms;
  const auto find = [&](const std::string& name) {
    return std::find_if(rooms.begin(), rooms.end(), [&](const RoomPlan& r) { return r.name == name; });
  };
  const std::vector<OpeningPlan> openings = place.plan.openings;
  for (const OpeningPlan& opening : openings) {
    if (opening.kind == OpeningPlan::Kind::window) continue;
    if (opening.rooms[1] == "outside") {
      const std::string number = opening.name.substr(opening.name.find('_') + 1);
      const int pick = place.random.integer(0, 27);
      place.signBeside(opening, opening.rooms[0], number, {number, pick < 20 ? kPeople[pick] : kUses[pick - 20]});
      continue;
    }
    const auto first = find(opening.rooms[0]), second = find(opening.rooms[1]);
    if (second->kind == "corridor" && first->kind != "corridor" && opening.width > 0) {
      std::vector<std::string> lines;
      if (first->kind == "office") lines = {first->number, kPeople[place.random.integer(0, 19)]};
      place.signBeside(opening, second->name, first->name, lines);
    }
  }
}

}  // namespace omnimapper::sim
