#include <cmath>

#include "PlaceGenerators.h"
#include "PlanVariation.h"

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;
using Kind = OpeningPlan::Kind;

struct RoomRow {
  const char *name, *kind, *number;
  double low_x, low_y, high_x, high_y, height;
  const char *wall, *floor;
};

template <std::size_t count>
void buildRooms(Arrangement& place, const RoomRow (&rows)[count]) {
  for (const RoomRow& row : rows) {
    RoomPlan& room = place.room(row.name, row.kind, {row.low_x, row.low_y}, {row.high_x, row.high_y});
    room.number = row.number;
    room.height = row.height;
    room.wall = row.wall;
    room.floor = row.floor;
  }
}

struct PassageRow {
  const char *first, *second;
  double x, y, width;  // width 0: the rooms touch, and are open to each other
};

template <std::size_t count>
void buildPassages(Arrangement& place, const PassageRow (&rows)[count]) {
  for (const PassageRow& row : rows)
    place.opening(Kind::passage, row.first, row.second, {row.x, row.y}).width = row.width;
}

// A cubicle: low walls on two sides of a place of work, and a desk.
void furnishCubicle(Arrangement& place, const Vector2d& middle, double size, bool faces_up) {
  const double out = faces_up ? 1 : -1, yaw = faces_up ? M_PI : 0;
  FurniturePlan wall;
  wall.shape = "partition";
  wall.x = middle.x();
  wall.y = middle.y() - out * (size / 2 - 0.04);
  wall.length = size - 0.1;
  wall.yaw = yaw;
  place.place(wall);
  wall.x = middle.x() - size / 2;
  wall.y = middle.y();
  wall.length = size - 0.25;
  wall.yaw = M_PI / 2;
  place.place(wall);
  FurniturePlan desk;
  desk.shape = "desk";
  desk.length = 1.8;
  desk.x = middle.x() + 0.05;
  desk.y = middle.y() - out * (size / 2 - 0.08 - 0.42);
  desk.yaw = yaw;
  const auto number = place.place(desk);
  if (!number) return;
  place.beside(*number, "office_chair", {-0.2, -0.6}, M_PI + place.random.uniform(-0.6, 0.6));
  place.objectsOn(*number, "top", 3, {"laptop", "cup", "book", "lamp", "can"});
}

// Cubicles in pairs of rows back to back, as many as the room holds, with an aisle between pairs, one in the middle of
// the rows, and 1 m of free floor along the walls.
void furnishCubicles(Arrangement& place) {
  constexpr double kCell = 2.6, kAisle = 1.8, kPairs = 7.0, kAtWall = 1.05;
  const Bounds bounds = boundsOf(place.roomNamed("cubicles").outline);
  const Vector2d size = bounds.high - bounds.low, centre = (bounds.low + bounds.high) / 2;
  const int columns = static_cast<int>((size.x() - 2 * kAtWall - kAisle) / kCell);
  const int pairs = static_cast<int>((size.y() - 2 * kAtWall + kPairs - 2 * kCell) / kPairs);
  const Vector2d first = centre - Vector2d(4.9 + kCell * (columns - 4) / 2, 5.5 + kPairs * (pairs - 2) / 2);
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < 2 * pairs; ++row) {
      const Vector2d middle(first.x() + column * kCell + (column >= columns / 2 ? kAisle : 0),
                            first.y() + (row / 2) * kPairs + (row % 2) * kCell);
      furnishCubicle(place, middle, kCell, row % 2 == 1);
    }
  }
}

void furnishAtrium(Arrangement& place) {
  const Room& atrium = place.roomNamed("atrium");
  const Bounds bounds = boundsOf(atrium.outline);
  const Vector2d centre = (bounds.low + bounds.high) / 2;
  FurniturePlan pillar;
  pillar.height = atrium.height;
  pillar.shape = "pillar";
  for (const double x : {-3.5, 3.5}) {
    for (const double y : {-4.0, 4.0}) {
      pillar.x = centre.x() + x;
      pillar.y = centre.y() + y;
      place.place(pillar);
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (const auto sofa = place.alongWall("atrium", "sofa", Along::anywhere, 0.9))
      place.beside(*sofa, "coffee_table", {0, -1.1}, 0);
    place.alongWall("atrium", "plant", Along::corner, 0);
  }
  FurniturePlan pane;
  pane.shape = "glass_pane";
  pane.length = 2.4;
  pane.x = centre.x();
  pane.y = centre.y();
  place.place(pane);
}

void buildOffice(Arrangement& place) {
  static const RoomRow rooms[] = {
      {"west_hall", "corridor", "", 0, 0, 2, 20, 2.7, "paint_white", "carpet_grey"},
      {"north_hall", "corridor", "", 2, 18, 34, 20, 2.7, "paint_white", "carpet_grey"},
      {"east_hall", "corridor", "", 34, 0, 36, 20, 2.7, "paint_white", "carpet_grey"},
      {"south_hall", "corridor", "", 2, 0, 34, 2, 2.7, "paint_white", "carpet_grey"},
      {"middle_hall", "corridor", "", 17, 2, 19, 18, 2.7, "paint_white", "carpet_grey"},
      {"cubicles", "cubicles", "130", 2.12, 2.12, 16.88, 17.88, 2.7, "paint_grey", "carpet_blue"},
      {"atrium", "atrium", "", 19.12, 2.12, 33.88, 17.88, 6.0, "plaster", "tiles_grey"},
      {"office_118", "office", "118", 4, 20.12, 8.4, 24.6, 2.7, "paint_white", "carpet_grey"},
      {"office_120", "office", "120", 12, 20.12, 16.4, 24.6, 2.7, "paint_white", "carpet_grey"},
      {"office_124", "office", "124", 26, 20.12, 30.4, 24.6, 2.7, "paint_white", "carpet_grey"},
      {"kitchen", "kitchen", "131", -5.12, 7, -0.12, 12, 2.7, "paint_cream", "tiles_white"},
      {"meeting_room", "meeting_room", "132", 8, -5.62, 14, -0.12, 2.7, "paint_blue", "carpet_grey"},
  };
  static const PassageRow passages[] = {
      {"west_hall", "north_hall", 2, 19, 0},     {"north_hall", "east_hall", 34, 19, 0},
      {"east_hall", "south_hall", 34, 1, 0},     {"south_hall", "west_hall", 2, 1, 0},
      {"middle_hall", "south_hall", 18, 2, 0},   {"middle_hall", "north_hall", 18, 18, 0},
      {"cubicles", "west_hall", 2.06, 7.6, 1.6}, {"cubicles", "middle_hall", 16.94, 7.6, 1.6},
      {"atrium", "middle_hall", 19.06, 10, 2.0}, {"atrium", "east_hall", 33.94, 10, 2.0},
      {"kitchen", "west_hall", -0.06, 9.5, 1.2},
  };
  buildRooms(place, rooms);
  buildPassages(place, passages);
  for (const Vector2d& at : {Vector2d(5, 20.06), Vector2d(13, 20.06), Vector2d(27, 20.06)}) {
    const std::string name = at.x() < 8 ? "office_118" : at.x() < 20 ? "office_120" : "office_124";
    place.opening(Kind::door, name, "north_hall", at);
    place.window(name, {at.x() + 1.2, 24.6}, 2.0);
  }
  place.opening(Kind::door, "meeting_room", "south_hall", {9, -0.06});
  place.window("meeting_room", {11, -5.62}, 2.4);
  place.window("kitchen", {-5.12, 9.5}, 1.6);
  int number = 140;
  for (const Vector2d& at : {Vector2d(0, 3), Vector2d(0, 15), Vector2d(36, 3), Vector2d(36, 8), Vector2d(36, 14),
                             Vector2d(20, 0), Vector2d(25, 0), Vector2d(30, 0), Vector2d(10.2, 20), Vector2d(19.5, 20),
                             Vector2d(23.5, 20), Vector2d(32.2, 20)}) {
    const std::string hall = at.x() == 0    ? "west_hall"
                             : at.x() == 36 ? "east_hall"
                             : at.y() == 0  ? "south_hall"
                                            : "north_hall";
    OpeningPlan& door = place.opening(Kind::door, hall, "outside", at);
    door.leaf = OpeningPlan::Leaf::closed;
    door.name = "door_" + std::to_string(++number);
  }
}

void furnishMeetingRoom(Arrangement& place) {
  FurniturePlan size;
  size.length = 2.8;
  size.width = 1.2;
  if (const auto table = place.inMiddle("meeting_room", "table", size)) place.chairsAround(*table, "office_chair", 8);
}

// Varies the plan: with or without the atrium and the second loop around it, a southern wing of two offices, and single
// rooms.
void varyOffice(Arrangement& place, int plan_seed) {
  PlanVariation variation(place.plan, plan_seed);
  if (variation.chance(0.5)) {
    static const RoomRow wing[] = {
        {"office_133", "office", "133", 19.5, -5.62, 23.9, -0.12, 2.7, "paint_white", "carpet_grey"},
        {"office_135", "office", "135", 24.02, -5.62, 28.4, -0.12, 2.7, "paint_white", "carpet_grey"},
    };
    buildRooms(place, wing);
    for (const RoomRow& row : wing) {
      place.opening(Kind::door, row.name, "south_hall", {(row.low_x + row.high_x) / 2, -0.06});
      place.window(row.name, {(row.low_x + row.high_x) / 2, -5.62}, 2.0);
    }
  }
  if (variation.chance(0.35)) variation.cutOffBeyond(19);
  for (const char* room : {"office_118", "office_120", "office_124", "kitchen", "meeting_room"})
    variation.maybeLeaveOut(room, 0.25);
  variation.redraw();
}

}  // namespace

void makeOffice(Arrangement& place, const WorldOptions& options) {
  buildOffice(place);
  if (options.plan_seed > 0) varyOffice(place, options.plan_seed);
  place.raise();
  addSigns(place);
  furnishCubicles(place);
  if (place.has("atrium")) furnishAtrium(place);
  for (const char* office : {"office_118", "office_120", "office_124", "office_133", "office_135"}) {
    if (place.has(office)) furnishOffice(place, office, 2);
  }
  if (place.has("kitchen")) furnishKitchenette(place, "kitchen");
  if (place.has("meeting_room")) furnishMeetingRoom(place);
  for (const char* hall : {"west_hall", "north_hall", "east_hall", "south_hall", "middle_hall"}) {
    if (!place.has(hall)) continue;
    place.scatter(hall, 0.02);
    place.postersIn(hall, 3);
  }
  place.carryObjects(0.3);
}

namespace {

void buildLaboratory(Arrangement& place) {
  static const RoomRow rooms[] = {
      {"west_hall", "corridor", "", -1.62, 0, -0.12, 11.62, 2.7, "paint_white", "linoleum"},
      {"north_hall", "corridor", "", -0.12, 10.12, 14.12, 11.62, 2.7, "paint_white", "linoleum"},
      {"east_hall", "corridor", "", 14.12, 0, 15.62, 11.62, 2.7, "paint_white", "linoleum"},
      {"laboratory", "laboratory", "210", 0, 0, 14, 10, 3.4, "paint_grey", "concrete"},
      {"office_211", "office", "211", -0.12, 11.74, 4.6, 15.8, 2.7, "paint_white", "carpet_grey"},
      {"storage_212", "storage", "212", 4.72, 11.74, 8.4, 15.8, 2.7, "paint_white", "concrete"},
      {"office_213", "office", "213", 8.52, 11.74, 14.12, 15.8, 2.7, "paint_white", "carpet_grey"},
  };
  static const PassageRow passages[] = {
      {"west_hall", "north_hall", -0.12, 11, 0},
      {"north_hall", "east_hall", 14.12, 11, 0},
      {"laboratory", "west_hall", -0.06, 2, 1.2},
      {"laboratory", "east_hall", 14.06, 7.5, 1.2},
  };
  buildRooms(place, rooms);
  buildPassages(place, passages);
  place.opening(Kind::door, "office_211", "north_hall", {1.5, 11.68});
  place.opening(Kind::door, "storage_212", "north_hall", {6.5, 11.68});
  place.opening(Kind::door, "office_213", "north_hall", {12.5, 11.68});
  place.window("laboratory", {4, 0}, 2.4);
  place.window("laboratory", {10, 0}, 2.4);
  place.window("office_211", {2, 15.8});
  place.window("office_213", {11, 15.8}, 2.0);
}

// Varies the plan: with or without a meeting room behind the eastern hall and each of the northern rooms, which are in
// this order or in reverse.
void varyLaboratory(Arrangement& place, int plan_seed) {
  PlanVariation variation(place.plan, plan_seed);
  if (variation.chance(0.5)) {
    static const RoomRow wing[] = {
        {"meeting_room", "meeting_room", "214", 15.74, 2, 20.2, 7, 2.7, "paint_blue", "carpet_grey"}};
    buildRooms(place, wing);
    place.opening(Kind::door, "meeting_room", "east_hall", {15.68, 4.5});
    place.window("meeting_room", {20.2, 4.5}, 2.0);
  }
  variation.maybeReverseRow({"office_211", "storage_212", "office_213"}, 7);
  for (const char* room : {"office_211", "storage_212", "office_213"}) variation.maybeLeaveOut(room, 0.25);
  variation.redraw();
}

}  // namespace

void makeLaboratory(Arrangement& place, const WorldOptions& options) {
  buildLaboratory(place);
  if (options.plan_seed > 0) varyLaboratory(place, options.plan_seed);
  place.raise();
  addSigns(place);
  furnishLaboratory(place, "laboratory");
  for (const char* office : {"office_211", "office_213"}) {
    if (place.has(office)) furnishOffice(place, office, 2);
  }
  if (place.has("meeting_room")) furnishMeetingRoom(place);
  const bool has_storage = place.has("storage_212");
  for (int i = 0; has_storage && i < 3; ++i) place.alongWall("storage_212", "rack", Along::corner, 0.6);
  place.scatter("laboratory", 0.12);
  if (has_storage) place.scatter("storage_212", 0.3);
  for (const char* hall : {"west_hall", "north_hall", "east_hall"}) place.postersIn(hall, 3);
  place.carryObjects(0.3);
}

void makeTwoOffices(Arrangement& place, const WorldOptions& options) {
  static const RoomRow rooms[] = {
      {"office_1", "office", "114", 0, 0, 4.5, 4.5, 2.6, "paint_white", "carpet_grey"},
      {"office_2", "office", "117", 13.5, 0, 18, 4.5, 2.6, "paint_white", "carpet_blue"},
      {"corridor", "corridor", "", 0, 4.62, 18, 6.62, 2.6, "paint_cream", "linoleum"},
  };
  buildRooms(place, rooms);
  place.opening(Kind::door, "office_1", "corridor", {3.0, 4.56});
  place.opening(Kind::door, "office_2", "corridor", {15.0, 4.56});
  int number = 117;
  for (const Vector2d& at :
       {Vector2d(7, 4.62), Vector2d(11, 4.62), Vector2d(3, 6.62), Vector2d(9, 6.62), Vector2d(15, 6.62)}) {
    OpeningPlan& door = place.opening(Kind::door, "corridor", "outside", at);
    door.leaf = OpeningPlan::Leaf::closed;
    door.name = "door_" + std::to_string(++number);
  }
  place.window("office_1", {2.2, 0}, 1.6);
  place.window("office_2", {15.8, 0}, 1.6);
  place.raise();
  addSigns(place);
  int id = 0;
  const auto pin = [&](const std::string& room, int count) {
    for (int i = 0; i < count; ++i) {
      MarkerPlan marker;
      const auto at =
          place.freeWall(room, (i + 0.5) / count, 1.15 + 0.2 * (i % 3), 4.0 / 3 * marker.side, 4.0 / 3 * marker.side);
      if (!at) continue;
      marker.id = id++;
      marker.name = "marker_" + std::to_string(marker.id);
      marker.at = *at;
      marker.is_landmark = true;
      place.plan.markers.push_back(marker);
    }
  };
  pin("office_1", 12);
  pin("office_2", 9);
  pin("corridor", 8);
  for (const char* room : {"office_1", "office_2"}) {
    furnishOffice(place, room, 3);
    if (const auto low = place.alongWall(room, "cabinet", Along::anywhere, 0.5))
      place.objectsOn(*low, "top", 1, {"box", "pot"});
  }
  for (int i = 0; i < 10; ++i) {
    MarkerPlan marker;
    const Vector2d reach(4.0 / 3 * marker.side, 0.08);
    const auto at = place.freePlace("office_1", reach);
    if (!at) continue;
    marker.id = id++;
    marker.name = "marker_" + std::to_string(marker.id);
    marker.on_wall = false;
    marker.place = *at;
    marker.is_landmark = true;
    const auto later = place.freePlace("office_2", reach);
    if (options.move_time >= 0 && later) marker.moves.push_back({options.move_time, later});
    place.plan.markers.push_back(marker);
  }
}

}  // namespace omnimapper::sim
