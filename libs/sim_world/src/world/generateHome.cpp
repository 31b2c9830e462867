#include "PlaceGenerators.h"
#include "PlanVariation.h"

namespace omnimapper::sim {

namespace {

using Kind = OpeningPlan::Kind;

void buildRooms(Arrangement& place) {
  struct Row {
    const char *name, *kind;
    double low_x, low_y, high_x, high_y;
    const char *wall, *floor;
  };
  static const Row rows[] = {
      {"living_room", "living_room", 0, 0, 5.4, 4.6, "paint_cream", "wood_floor"},
      {"kitchen", "kitchen", 5.52, 0, 9.4, 4.6, "paint_white", "tiles_grey"},
      {"hallway", "hallway", 0, 4.72, 9.4, 6.1, "paint_white", "wood_floor"},
      {"bedroom", "bedroom", 0, 6.22, 4.2, 9.8, "paint_blue", "carpet_grey"},
      {"bathroom", "bathroom", 4.32, 6.22, 6.5, 8.9, "tiles_white", "tiles_white"},
      {"study", "study", 6.62, 6.22, 9.4, 9.8, "paint_green", "wood_floor"},
  };
  for (const Row& row : rows) {
    RoomPlan& room = place.room(row.name, row.kind, {row.low_x, row.low_y}, {row.high_x, row.high_y});
    room.wall = row.wall;
    room.floor = row.floor;
  }
}

void buildOpenings(Arrangement& place) {
  place.opening(Kind::passage, "living_room", "hallway", {1.2, 4.66}).width = 1.0;
  place.opening(Kind::passage, "living_room", "kitchen", {5.46, 3.2}).width = 1.6;
  place.opening(Kind::door, "kitchen", "hallway", {8.3, 4.66}).hinge_right = true;
  place.opening(Kind::door, "bedroom", "hallway", {3.4, 6.16});
  place.opening(Kind::door, "bathroom", "hallway", {5.0, 6.16}).width = 0.8;
  place.opening(Kind::door, "study", "hallway", {8.7, 6.16});
  OpeningPlan& entrance = place.opening(Kind::door, "hallway", "outside", {0, 5.41});
  entrance.width = 0.95;
  entrance.leaf = OpeningPlan::Leaf::closed;
  entrance.material = "door_grey";
  place.window("living_room", {1.6, 0}, 1.8);
  place.window("living_room", {0, 2.4}, 1.4);
  place.window("kitchen", {7.4, 0}, 1.4);
  place.window("bedroom", {2.1, 9.8}, 1.6);
  place.window("bathroom", {5.4, 8.9}, 0.6);
  place.window("study", {9.4, 8.2}, 1.4);
}

void varyHome(Arrangement& place, int plan_seed) {
  PlanVariation variation(place.plan, plan_seed);
  variation.maybeLeaveOut("study", 0.4);
  variation.maybeReverseRow({"living_room", "kitchen"}, 4.7);
  variation.maybeReverseRow({"bedroom", "bathroom", "study"}, 4.7);
  variation.redraw();
}

void furnishLivingRoom(Arrangement& place) {
  const std::string room = "living_room";
  if (const auto sofa = place.alongWall(room, "sofa", Along::middle, 0.9)) {
    const auto low = place.beside(*sofa, "coffee_table", {0, -0.45 - 0.35 - 0.3}, 0);
    if (low) place.objectsOn(*low, "top", 3, {"cup", "book", "bowl", "plate"});
  }
  if (const auto board = place.alongWall(room, "sideboard", Along::middle, 0.6)) {
    place.objectsOn(*board, "top", 3, {"lamp", "book", "pot", "box"});
  }
  place.alongWall(room, "bookcase", Along::corner);
  place.alongWall(room, "armchair", Along::corner, 0.4);
  place.alongWall(room, "plant", Along::corner, 0);
}

void furnishKitchen(Arrangement& place) {
  const std::string room = "kitchen";
  FurniturePlan run;
  run.length = 2.4;
  // The counter runs below the window, stove and fridge beside it.
  const auto counter = place.alongWall(room, "counter", Along::middle, 0.9, run);
  if (counter) {
    place.objectsOn(*counter, "top", 5, {"pot", "bottle", "can", "bowl", "box", "cup"});
    const double half = place.plan.furniture[*counter].length / 2;
    place.beside(*counter, "stove", {half + 0.31, 0}, 0);
    place.beside(*counter, "fridge", {-half - 0.32, -0.02}, 0);
  }
  run.length = 1.6;
  place.alongWall(room, "wall_cabinet", Along::anywhere, 0, run);
  FurniturePlan size;
  size.length = 1.4;
  size.width = 0.8;
  if (const auto table = place.inMiddle(room, "table", size)) {
    place.chairsAround(*table, "chair", 4);
    place.objectsOn(*table, "top", 4, {"plate", "cup", "bowl", "bottle"});
  }
}

void furnishBedroom(Arrangement& place) {
  const std::string room = "bedroom";
  if (const auto bed = place.alongWall(room, "bed", Along::middle, 0.5)) {
    for (const double side : {-1.05, 1.05}) {
      const auto stand = place.beside(*bed, "bedside_table", {side, 0.83}, 0);
      if (stand) place.objectsOn(*stand, "top", 1, {"lamp", "book", "cup"});
    }
  }
  place.alongWall(room, "wardrobe", Along::corner, 0.7);
  place.alongWall(room, "cabinet", Along::anywhere, 0.5);
  place.alongWall(room, "chair", Along::corner, 0.2);
}

void furnishBathroom(Arrangement& place) {
  place.alongWall("bathroom", "bathtub", Along::corner, 0.5);
  place.alongWall("bathroom", "toilet", Along::anywhere, 0.5);
  place.alongWall("bathroom", "washbasin", Along::anywhere, 0.5);
}

void furnishStudy(Arrangement& place) {
  FurniturePlan size;
  size.length = 1.5;
  size.width = 0.7;
  if (const auto desk = place.alongWall("study", "desk", Along::middle, 0.8, size)) {
    place.beside(*desk, "office_chair", {-0.2, -0.55}, M_PI + place.random.uniform(-0.4, 0.4));
    place.objectsOn(*desk, "top", 4, {"laptop", "cup", "book", "lamp"});
  }
  if (const auto shelf = place.alongWall("study", "shelf", Along::corner)) {
    place.objectsOn(*shelf, "board_3", 2, {"box", "book", "can"});
    place.objectsOn(*shelf, "board_4", 2, {"box", "ball", "cup"});
  }
  place.alongWall("study", "bookcase", Along::corner);
}

void furnishHallway(Arrangement& place) {
  FurniturePlan narrow;
  narrow.length = 1.0;
  narrow.width = 0.3;
  if (const auto board = place.alongWall("hallway", "sideboard", Along::anywhere, 0.6, narrow))
    place.objectsOn(*board, "top", 2, {"bowl", "box", "ball"});
}

}  // namespace

void makeHome(Arrangement& place, const WorldOptions& options) {
  buildRooms(place);
  buildOpenings(place);
  if (options.plan_seed > 0) varyHome(place, options.plan_seed);
  place.raise();
  furnishLivingRoom(place);
  furnishKitchen(place);
  furnishBedroom(place);
  furnishBathroom(place);
  if (place.has("study")) furnishStudy(place);
  furnishHallway(place);
  for (const char* room : {"living_room", "kitchen", "hallway", "bedroom", "study"}) {
    if (place.has(room)) place.scatter(room, 0.1);
  }
  for (const char* room : {"living_room", "hallway", "bedroom", "study"}) {
    if (place.has(room)) place.postersIn(room, 2);
  }
  place.carryObjects(0.4);
}

}  // namespace omnimapper::sim
