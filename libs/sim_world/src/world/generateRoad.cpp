#include <cmath>

#include "PlaceGenerators.h"

namespace omnimapper::sim {

namespace {

constexpr double kHalfRoad = 3.5, kVerge = 7.0, kKerb = 0.12;  // [m]

struct Stretch {
  double low, high, floor, slope;
};
constexpr Stretch kStretches[] = {{0, 20, 0, 0}, {20, 45, 0, 0.06}, {45, 65, 1.5, 0}};

void buildGround(Arrangement& place) {
  int count = 0;
  for (const Stretch& stretch : kStretches) {
    const std::string number = std::to_string(++count);
    const auto ground = [&](const std::string& name, const char* kind, double low_y, double high_y, double lift) {
      RoomPlan& room = place.room(name + number, kind, {stretch.low, low_y}, {stretch.high, high_y});
      room.is_outdoors = true;
      room.floor_z = stretch.floor + lift;
      room.slope_x = stretch.slope;
      room.floor = name == "road_" ? "asphalt" : "pavement";
    };
    ground("road_", "road", -kHalfRoad, kHalfRoad, 0);
    ground("left_", "sidewalk", kHalfRoad, kHalfRoad + kVerge, kKerb);
    ground("right_", "sidewalk", -kHalfRoad - kVerge, -kHalfRoad, kKerb);
  }
}

void lineWithKerbs(Arrangement& place) {
  for (const Stretch& stretch : kStretches) {
    const int pieces = static_cast<int>((stretch.high - stretch.low) / 5);
    const double step = (stretch.high - stretch.low) / pieces;
    for (int i = 0; i < pieces; ++i) {
      for (const double side : {-1.0, 1.0}) {
        FurniturePlan kerb;
        kerb.shape = "kerb";
        kerb.length = step - 0.01;
        kerb.x = stretch.low + (i + 0.5) * step;
        kerb.y = side * (kHalfRoad - 0.076);
        kerb.height = kKerb;
        kerb.yaw = side > 0 ? 0 : M_PI;
        place.place(kerb);
      }
    }
  }
}

void lineWithHouses(Arrangement& place) {
  static const char* const walls[] = {"plaster", "brick", "paint_cream", "paint_grey"};
  for (const double side : {-1.0, 1.0}) {
    for (double x = 0.5; x < 58;) {
      FurniturePlan house;
      house.shape = "house";
      house.length = place.random.uniform(6.5, 10.5);
      house.width = 3;
      house.z = -0.6;  // its foot is in the ground, sloped or not
      house.height = 0.6 + place.random.uniform(5.8, 9.2);
      house.x = x + house.length / 2;
      house.y = side * (kHalfRoad + kVerge - 1.6);
      house.yaw = side > 0 ? 0 : M_PI;
      house.material = walls[place.random.integer(0, 3)];
      place.place(house);
      x += house.length + place.random.uniform(0.3, 2.5);
    }
  }
}

void addCarsAndStreetFurniture(Arrangement& place) {
  static const char* const paints[] = {"car_red", "car_silver", "car_blue"};
  static const double share[] = {0.25, 0.5, 0.8};
  for (const double side : {-1.0, 1.0}) {
    for (double x = 4; x < 61; x += 6) {
      if (place.random.chance(share[static_cast<int>(place.clutter)])) {
        FurniturePlan car;
        car.shape = "car";
        car.x = x + place.random.uniform(-0.4, 0.4);
        car.y = side * (kHalfRoad - 1.15);
        car.yaw = side > 0 ? M_PI : 0;
        car.material = paints[place.random.integer(0, 2)];
        place.place(car);
      }
      FurniturePlan item;
      static const char* const shapes[] = {"lamp_post", "tree", "bollard", "hedge", "bin"};
      const int pick = place.random.integer(0, 4);
      item.shape = shapes[pick];
      item.x = x + 2.5;
      item.y = side * (kHalfRoad + (pick == 3 ? 3.2 : 1.3));
      item.yaw = side > 0 ? 0 : M_PI;
      place.place(item);
    }
  }
}

}  // namespace

void makeRoad(Arrangement& place, const WorldOptions&) {
  buildGround(place);
  place.raise();
  lineWithKerbs(place);
  lineWithHouses(place);
  addCarsAndStreetFurniture(place);
}

}  // namespace omnimapper::sim
