#include <cmath>

#include "generators.h"

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

// Places of work in two rows back to back, with low walls around each.
void furnishCubicles(Arrangement& place) {
  constexpr double kCell = 2.6;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      const bool faces_up = row % 2 == 1;
      const Vector2d middle(4.6 + column * kCell + (column >= 2 ? 1.8 : 0), 4.5 + (row / 2) * 7.0 + (row % 2) * kCell);
      const double out = faces_up ? 1 : -1, yaw = faces_up ? M_PI : 0;
      FurniturePlan wall;
      wall.shape = "partition";
      wall.x = middle.x();
      wall.y = middle.y() - out * (kCell / 2 - 0.04);
      wall.length = kCell - 0.1;
      wall.yaw = yaw;
      place.place(wall);
      wall.x = middle.x() - kCell / 2;
      wall.y = middle.y();
      wall.length = kCell - 0.25;
      wall.yaw = M_PI / 2;
      place.place(wall);
      FurniturePlan desk;
      desk.shape = "desk";
      desk.length = 1.8;
      desk.x = middle.x() + 0.05;
      desk.y = middle.y() - out * (kCell / 2 - 0.08 - 0.42);
      desk.yaw = yaw;
      const auto number = place.place(desk);
      if (!number) continue;
      place.beside(*number, "office_chair", {-0.2, -0.6}, M_PI + place.random.uniform(-0.6, 0.6));
      place.objectsOn(*number, "top", 3, {"laptop", "cup", "book", "lamp", "can"});
    }
  }
}

void furnishAtrium(Arrangement& place) {
  FurniturePlan pillar;
  pillar.height = 6;
  pillar.shape = "pillar";
  for (const double x : {23.0, 30.0}) {
    for (const double y : {6.0, 14.0}) {
      pillar.x = x;
      pillar.y = y;
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
  pane.x = 26.5;
  pane.y = 10;
  place.place(pane);
}

}  // namespace

void makeOffice(Arrangement& place, const WorldOptions&) {
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
  place.raise();
  addSigns(place);
  furnishCubicles(place);
  furnishAtrium(place);
  for (const char* office : {"office_118", "office_120", "office_124"}) furnishOffice(place, office, 2);
  furnishKitchenette(place, "kitchen");
  FurniturePlan size;
  size.length = 2.8;
  size.width = 1.2;
  if (const auto table = place.inMiddle("meeting_room", "table", size)) place.chairsAround(*table, "office_chair", 8);
  for (const char* hall : {"west_hall", "north_hall", "east_hall", "south_hall", "middle_hall"}) {
    place.scatter(hall, 0.02);
    place.postersIn(hall, 3);
  }
  place.carryObjects(0.3);
}

void makeLaboratory(Arrangement& place, const WorldOptions&) {
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
  place.raise();
  addSigns(place);
  furnishLaboratory(place, "laboratory");
  furnishOffice(place, "office_211", 2);
  furnishOffice(place, "office_213", 2);
  for (int i = 0; i < 3; ++i) place.alongWall("storage_212", "rack", Along::corner, 0.6);
  place.scatter("laboratory", 0.12);
  place.scatter("storage_212", 0.3);
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
