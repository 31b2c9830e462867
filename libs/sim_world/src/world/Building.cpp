#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/Building.h>
#include <omnimapper/sim_world/Materials.h>

#include <algorithm>

#include "Openings.h"
#include "PlanChecks.h"
#include "WallFaces.h"

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::vector<Room> makeRooms(const WorldPlan& plan) {
  std::vector<Room> rooms;
  for (const RoomPlan& from : plan.rooms) {
    if (!isSimple(from.outline))
      refuse(plan, from.name, "outline_m", "must have three corners or more and must not cross itself");
    refuseUnknownMaterial(plan, from.name, "wall", from.wall);
    refuseUnknownMaterial(plan, from.name, "floor", from.floor);
    refuseUnknownMaterial(plan, from.name, "ceiling", from.ceiling);
    Room room;
    room.name = from.name;
    room.kind = from.kind;
    room.number = from.number;
    room.outline = from.outline;
    if (doubleArea(room.outline) < 0) std::reverse(room.outline.begin() + 1, room.outline.end());
    room.floor_z = from.floor_z;
    room.height = from.height;
    room.slope = {from.slope_x, from.slope_y};
    room.is_outdoors = from.is_outdoors;
    for (const Room& other : rooms) {
      if (overlap(room.outline, other.outline))
        refuse(plan, from.name, "outline_m", "overlaps the room '" + other.name + "'");
    }
    rooms.push_back(std::move(room));
  }
  return rooms;
}

// Rooms that touch need a passage over their whole common border, or two wall faces would coincide.
void refuseTouching(const WorldPlan& plan, const Building& building) {
  for (const WallFace& a : building.walls) {
    for (const WallFace& b : building.walls) {
      const auto shared = facing(a, b);
      if (!shared || shared->gap > kSamePlace) continue;
      const bool open = std::any_of(a.holes.begin(), a.holes.end(), [&](const WallFace::Hole& hole) {
        return hole.is_from_floor && hole.low_u <= shared->low_u + kSamePlace &&
               hole.high_u >= shared->high_u - kSamePlace;
      });
      if (open) continue;
      refuse(plan, building.rooms[a.room].name, "outline_m",
             "touches the room '" + building.rooms[b.room].name + "': leave a wall between, or join both by a passage");
    }
  }
}

Body makeBody(const RoomPlan& plan, const Room& room, int number, std::vector<WallFace>& walls) {
  MeshBuilder builder(room.name);
  std::vector<Vector3d> floor, ceiling;
  for (const Vector2d& p : room.outline) {
    floor.emplace_back(p.x(), p.y(), room.floorAt(p));
    ceiling.emplace(ceiling.begin(), p.x(), p.y(), room.floorAt(p) + room.height);
  }
  const NamedMaterial floor_material = materialNamed(plan.floor);
  const bool is_road = room.is_outdoors && room.kind == "road";
  builder.layout(floor_material.layout)
      .addPlane("floor", is_road ? SurfaceKind::road : SurfaceKind::floor, floor_material.material, floor);
  const auto built = [&] {
    constexpr double kRamp = 0.035;  // [m/m]
    Body body = builder.build();
    if (room.slope.norm() > kRamp) body.surfaces.front().is = surfaces::SurfaceClass::ramp;
    return body;
  };
  if (room.is_outdoors) return built();
  const NamedMaterial ceiling_material = materialNamed(plan.ceiling), wall_material = materialNamed(plan.wall);
  builder.layout(ceiling_material.layout).addPlane("ceiling", SurfaceKind::ceiling, ceiling_material.material, ceiling);
  builder.layout(wall_material.layout);
  int count = 0;
  for (WallFace& wall : walls) {
    if (wall.room != number) continue;
    const std::string part = "wall_" + std::to_string(++count);
    wall.surface = room.name + "/" + part;
    std::vector<Vector3d> outline;
    for (const Vector2d& p : outlineOf(wall)) outline.push_back(wall.at(p.x(), p.y()));
    std::vector<std::vector<Vector3d>> holes;
    for (const WallFace::Hole& hole : wall.holes) {
      if (hole.is_from_floor) continue;
      holes.push_back({wall.at(hole.low_u, hole.low_z), wall.at(hole.low_u, hole.high_z),
                       wall.at(hole.high_u, hole.high_z), wall.at(hole.high_u, hole.low_z)});
    }
    builder.addPlane(part, SurfaceKind::wall, wall_material.material, outline, holes);
  }
  return built();
}

void cutHole(const WorldPlan& plan, const FittedOpening& opening, double low_u, double high_u, WallFace& wall) {
  for (const WallFace::Hole& other : wall.holes) {
    if (low_u < other.high_u && other.low_u < high_u)
      refuse(plan, opening.plan->name, "x_m", "overlaps another opening of the wall");
  }
  wall.holes.push_back({low_u, high_u, opening.low_z, opening.high_z, opening.plan->sill == 0});
  std::sort(wall.holes.begin(), wall.holes.end(), [](const auto& a, const auto& b) { return a.low_u < b.low_u; });
}

// Cuts the hole into the wall of each room that the opening joins.
void cutOpening(const WorldPlan& plan, const FittedOpening& opening, std::vector<WallFace>& walls) {
  WallFace& wall = walls[opening.wall];
  cutHole(plan, opening, opening.low_u, opening.high_u, wall);
  if (opening.other_wall < 0) return;
  WallFace& other = walls[opening.other_wall];
  cutHole(plan, opening, other.alongOf(wall.start + opening.high_u * wall.direction),
          other.alongOf(wall.start + opening.low_u * wall.direction), other);
}

// Adds the solid behind a wall, without the openings that people walk through.
void addObstacles(const WallFace& wall, std::vector<Ring>& obstacles) {
  double from = 0;
  const auto add = [&](double to) {
    if (to - from <= kFloorTolerance) return;
    const Vector2d a = wall.start + from * wall.direction, b = wall.start + to * wall.direction;
    const Vector2d behind = -wall.solid * wall.inward();
    obstacles.push_back({a, b, b + behind, a + behind});
  };
  for (const WallFace::Hole& hole : wall.holes) {
    if (!hole.is_from_floor) continue;
    add(hole.low_u);
    from = hole.high_u;
  }
  add(wall.length);
}

}  // namespace

std::optional<int> roomAt(const std::vector<Room>& rooms, const Vector2d& in_map) {
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    if (contains(rooms[i].outline, in_map)) return static_cast<int>(i);
  }
  return {};
}

Building makeBuilding(const WorldPlan& plan) {
  Building building;
  building.rooms = makeRooms(plan);
  building.walls = makeWalls(building.rooms);
  std::vector<FittedOpening> openings;
  for (const OpeningPlan& opening : plan.openings) {
    refuseUnknownMaterial(plan, opening.name, "material", opening.material);
    openings.push_back(fitOpening(plan, opening, building.rooms, building.walls));
    cutOpening(plan, openings.back(), building.walls);
  }
  refuseTouching(plan, building);
  const std::vector<WallFace> uncut = building.walls;
  std::vector<WallFace> pieces;
  for (const WallFace& wall : uncut) {
    for (const WallFace& piece : withoutGaps(wall)) pieces.push_back(piece);
  }
  building.walls = joined(plan, std::move(pieces));
  for (std::size_t i = 0; i < building.rooms.size(); ++i) {
    building.bodies.push_back(makeBody(plan.rooms[i], building.rooms[i], static_cast<int>(i), building.walls));
  }
  for (const WallFace& wall : building.walls) addObstacles(wall, building.obstacles);
  for (const FittedOpening& opening : openings) addOpening(opening, uncut, building);
  return building;
}

}  // namespace omnimapper::sim
