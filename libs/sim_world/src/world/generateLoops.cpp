#include <cmath>

#include "PlaceGenerators.h"

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;
using Kind = OpeningPlan::Kind;

// A room that interrupts one side of the ring in its middle: `length` along the side, `depth` to the outside.
struct Inserted {
  const char *name, *kind, *floor;
  double length, depth, height;
};

struct Ringway {
  Arrangement& place;
  double width, height;
  const char* floor;
  std::vector<std::string> halls;

  void hall(const std::string& name, const Vector2d& low, const Vector2d& high) {
    RoomPlan& room = place.room(name, "corridor", low, high);
    room.height = height;
    room.floor = floor;
    halls.push_back(name);
  }
  void join(const std::string& first, const std::string& second, const Vector2d& at) {
    place.opening(Kind::passage, first, second, at).width = 0;
  }

  /// Adds a side of the ring along an axis, with or without the corners at its ends; `out` is the sign of the direction
  /// to the outside. Returns the names of its first and last room.
  std::pair<std::string, std::string> side(const std::string& name, const Vector2d& low, const Vector2d& high, int axis,
                                           double out, const Inserted* inserted) {
    if (!inserted) {
      hall(name, low, high);
      return {name, name};
    }
    const double middle = (low[axis] + high[axis]) / 2, half = inserted->length / 2;
    Vector2d cut_high = high, cut_low = low, room_low = low, room_high = high;
    cut_high[axis] = room_low[axis] = middle - half;
    cut_low[axis] = room_high[axis] = middle + half;
    if (out > 0) {
      room_high[1 - axis] += inserted->depth;
    } else {
      room_low[1 - axis] -= inserted->depth;
    }
    hall(name + "_1", low, cut_high);
    RoomPlan& room = place.room(inserted->name, inserted->kind, room_low, room_high);
    room.height = inserted->height;
    room.floor = inserted->floor;
    hall(name + "_2", cut_low, high);
    Vector2d joint = low;
    joint[axis] = middle - half;
    join(name + "_1", inserted->name, joint);
    joint[axis] = middle + half;
    join(inserted->name, name + "_2", joint);
    return {name + "_1", name + "_2"};
  }
};

// The west and east halls contain the corners.
void buildRing(Ringway& ring, double length, const Inserted* north, const Inserted* east, const Inserted* south) {
  const double across = 0.3 * length, up = 0.5 * length - across, w = ring.width;
  const auto west = ring.side("west_hall", {0, 0}, {w, up + w}, 1, -1, nullptr);
  const auto top = ring.side("north_hall", {w, up}, {across, up + w}, 0, 1, north);
  const auto right = ring.side("east_hall", {across, 0}, {across + w, up + w}, 1, 1, east);
  const auto bottom = ring.side("south_hall", {w, 0}, {across, w}, 0, -1, south);
  ring.join(west.second, top.first, {w, up + w / 2});
  ring.join(top.second, right.second, {across, up + w / 2});
  ring.join(bottom.second, right.first, {across, w / 2});
  ring.join(west.first, bottom.first, {w, w / 2});
}

}  // namespace

void makeLoop(Arrangement& place, const WorldOptions& options) {
  const bool is_short = options.length < 60;
  Ringway ring{place, is_short ? 1.8 : 2.2, 2.7, "linoleum", {}};
  static const Inserted small_laboratory{"laboratory", "laboratory", "concrete", 5.0, 4.0, 2.7};
  static const Inserted laboratory{"laboratory", "laboratory", "concrete", 12.0, 7.0, 3.2};
  static const Inserted atrium{"atrium", "atrium", "tiles_grey", 14.0, 8.0, 5.0};
  static const Inserted kitchen{"kitchen", "kitchen", "tiles_white", 6.0, 3.5, 2.7};
  buildRing(ring, options.length, options.length >= 150 ? &atrium : nullptr, options.length >= 300 ? &kitchen : nullptr,
            is_short ? &small_laboratory : &laboratory);
  int number = 200;
  for (const std::string& hall : ring.halls) addDoorsAlong(place, hall, is_short ? 2.0 : 5.0, number);
  place.raise();
  addSigns(place);
  furnishLaboratory(place, "laboratory");
  if (options.length >= 150) {
    for (int i = 0; i < 3; ++i) {
      place.alongWall("atrium", "sofa", Along::anywhere, 0.8);
      place.alongWall("atrium", "plant", Along::corner, 0);
    }
  }
  if (options.length >= 300) furnishKitchenette(place, "kitchen");
  for (const std::string& hall : ring.halls) {
    // The back of the building is being rebuilt, so there is more clutter in the south halls.
    place.scatter(hall, hall.compare(0, 5, "south") == 0 ? 0.08 : 0.01);
    place.postersIn(hall, is_short ? 1 : 5);
  }
}

void makeCorridorLoop(Arrangement& place, const WorldOptions& options) {
  Ringway ring{place, 3.0, 3.2, "concrete", {}};
  static const Inserted hall{"hall", "hall", "concrete", 16.0, 6.0, 6.0};
  buildRing(ring, options.length, &hall, nullptr, nullptr);
  int number = 0;
  for (const std::string& name : ring.halls) addDoorsAlong(place, name, 9.0, number);
  place.raise();
  addSigns(place);
  for (const std::string& name : ring.halls) place.scatter(name, 0.015);
  for (int i = 0; i < 4; ++i)
    place.inMiddle("hall", "pillar", [] {
      FurniturePlan pillar;
      pillar.height = 6;
      return pillar;
    }());
}

}  // namespace omnimapper::sim
