#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/sim/Building.h>
#include <omnimapper/sim/Materials.h>

#include <algorithm>

#include "PlanChecks.h"

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSame = 1e-9;

std::vector<Room> makeRooms(const WorldPlan& plan) {
  std::vector<Room> rooms;
  for (const RoomPlan& from : plan.rooms) {
    if (!isSimple(from.outline))
      refuse(plan, from.name, "outline_m", "must be three corners or more, and cross itself nowhere");
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

// Where two walls look at each other across the solid between their rooms: how thick it is, and what they share in the
// first one's u.
struct Facing {
  double gap = 0, low_u = 0, high_u = 0;
};
std::optional<Facing> facing(const WallFace& a, const WallFace& b) {
  if ((a.direction + b.direction).norm() > kSame) return {};
  const double gap = -a.distanceTo(b.start);
  if (gap < -kSame) return {};
  const double low = std::max(0.0, a.alongOf(b.end())), high = std::min(a.length, a.alongOf(b.start));
  if (high - low <= kFloorTolerance) return {};
  return Facing{std::max(0.0, gap), low, high};
}

void setSolids(std::vector<WallFace>& walls) {
  for (WallFace& wall : walls) {
    for (const WallFace& other : walls) {
      const auto shared = facing(wall, other);
      if (shared && shared->gap > kSame) wall.solid = std::min(wall.solid, shared->gap);
    }
  }
}

// Rooms that touch need a passage over all they share, or two faces of walls would lie in one place.
void refuseTouching(const WorldPlan& plan, const Building& building) {
  for (const WallFace& a : building.walls) {
    for (const WallFace& b : building.walls) {
      const auto shared = facing(a, b);
      if (!shared || shared->gap > kSame) continue;
      const bool open = std::any_of(a.holes.begin(), a.holes.end(), [&](const WallFace::Hole& hole) {
        return hole.is_from_floor && hole.low_u <= shared->low_u + kSame && hole.high_u >= shared->high_u - kSame;
      });
      if (open) continue;
      refuse(plan, building.rooms[a.room].name, "outline_m",
             "touches the room '" + building.rooms[b.room].name + "': leave a wall between, or join both by a passage");
    }
  }
}

// A face without the parts that are open from floor to ceiling.
std::vector<WallFace> withoutGaps(const WallFace& wall) {
  std::vector<WallFace> pieces;
  double from = 0;
  const auto add = [&](double to) {
    if (to - from <= kFloorTolerance) return;
    WallFace piece = wall;
    piece.start = wall.start + from * wall.direction;
    piece.length = to - from;
    piece.floor_start = wall.floorAt(from);
    piece.floor_end = wall.floorAt(to);
    piece.ceiling_start = wall.ceilingAt(from);
    piece.ceiling_end = wall.ceilingAt(to);
    piece.holes.clear();
    for (WallFace::Hole hole : wall.holes) {
      if (hole.low_u < from - kSame || hole.high_u > to + kSame) continue;
      hole.low_u -= from;
      hole.high_u -= from;
      piece.holes.push_back(hole);
    }
    pieces.push_back(std::move(piece));
  };
  for (const WallFace::Hole& hole : wall.holes) {
    const double ceiling = std::min(wall.ceilingAt(hole.low_u), wall.ceilingAt(hole.high_u));
    if (!hole.is_from_floor || hole.high_z < ceiling - kSame) continue;
    add(hole.low_u);
    from = hole.high_u;
  }
  add(wall.length);
  return pieces;
}

bool continues(const WallFace& a, const WallFace& b) {
  const double rise_a = (a.floor_end - a.floor_start) / a.length, rise_b = (b.floor_end - b.floor_start) / b.length;
  return (a.direction - b.direction).norm() < kSame && (a.end() - b.start).norm() < kSame &&
         std::abs(a.floor_end - b.floor_start) < kSame && std::abs(a.ceiling_end - b.ceiling_start) < kSame &&
         std::abs(rise_a - rise_b) < kSame;
}

// What is one wall to the eye is one face, though it bounds several rooms that are open to each other.
std::vector<WallFace> joined(const WorldPlan& plan, std::vector<WallFace> walls) {
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::size_t j = 0; j < walls.size(); ++j) {
      WallFace &a = walls[i], &b = walls[j];
      if (i == j || !continues(a, b) || plan.rooms[a.room].wall != plan.rooms[b.room].wall) continue;
      for (WallFace::Hole hole : b.holes) {
        hole.low_u += a.length;
        hole.high_u += a.length;
        a.holes.push_back(hole);
      }
      a.length += b.length;
      a.floor_end = b.floor_end;
      a.ceiling_end = b.ceiling_end;
      if (a.room > b.room) a.room = b.room;
      walls.erase(walls.begin() + static_cast<std::ptrdiff_t>(j));
      if (j < i) --i;
      j = static_cast<std::size_t>(-1);  // begin again: the longer one may go on
    }
  }
  return walls;
}

Ring outlineOf(const WallFace& wall) {
  Ring ring{{0, wall.floor_start}};
  for (const WallFace::Hole& hole : wall.holes) {
    if (!hole.is_from_floor) continue;
    ring.insert(ring.end(), {{hole.low_u, wall.floorAt(hole.low_u)},
                             {hole.low_u, hole.high_z},
                             {hole.high_u, hole.high_z},
                             {hole.high_u, wall.floorAt(hole.high_u)}});
  }
  ring.insert(ring.end(), {{wall.length, wall.floor_end}, {wall.length, wall.ceiling_end}, {0, wall.ceiling_start}});
  // A notch at an end leaves corners that are none.
  for (std::size_t i = 0; i < ring.size();) {
    const Vector2d &before = ring[(i + ring.size() - 1) % ring.size()], &after = ring[(i + 1) % ring.size()];
    if (std::abs(doubleArea({before, ring[i], after})) > 1e-12) {
      ++i;
      continue;
    }
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;
  }
  return ring;
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
  if (room.is_outdoors) return builder.build();
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
  return builder.build();
}

// The solid behind a wall, without the openings that people walk through.
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

Vector3d WallFace::at(double u, double z) const {
  const Vector2d p = start + u * direction;
  return {p.x(), p.y(), z};
}

std::optional<int> roomAt(const std::vector<Room>& rooms, const Vector2d& in_map) {
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    if (contains(rooms[i].outline, in_map)) return static_cast<int>(i);
  }
  return {};
}

std::vector<WallFace> makeWalls(const WorldPlan&, const std::vector<Room>& rooms) {
  std::vector<WallFace> walls;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const Room& room = rooms[i];
    if (room.is_outdoors) continue;
    for (std::size_t k = 0; k < room.outline.size(); ++k) {
      // The room lies to the left of its outline: who looks at the wall sees the end of the edge on the left.
      const Vector2d &right = room.outline[k], &left = room.outline[(k + 1) % room.outline.size()];
      WallFace wall;
      wall.room = static_cast<int>(i);
      wall.start = left;
      wall.length = (right - left).norm();
      wall.direction = (right - left) / wall.length;
      wall.floor_start = room.floorAt(left);
      wall.floor_end = room.floorAt(right);
      wall.ceiling_start = wall.floor_start + room.height;
      wall.ceiling_end = wall.floor_end + room.height;
      walls.push_back(wall);
    }
  }
  return walls;
}

FittedOpening fitOpening(const WorldPlan& plan, const OpeningPlan& opening, const std::vector<Room>& rooms,
                         const std::vector<WallFace>& walls) {
  std::array<int, 2> wanted{-1, -1};
  const bool outside = opening.rooms.size() == 2 && opening.rooms[1] == "outside";
  if (opening.rooms.size() != 2) refuse(plan, opening.name, "rooms", "must name the two rooms it joins");
  for (int side = 0; side < (outside ? 1 : 2); ++side) {
    for (std::size_t i = 0; i < rooms.size(); ++i) {
      if (rooms[i].name == opening.rooms[side]) wanted[side] = static_cast<int>(i);
    }
    if (wanted[side] < 0) refuse(plan, opening.name, "rooms", "there is no room '" + opening.rooms[side] + "'");
  }
  const Vector2d point(opening.x, opening.y);
  FittedOpening best;
  Facing best_share;
  double best_distance = 1.0;  // farther than this the point is at no wall of theirs
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (walls[i].room != wanted[0]) continue;
    const auto consider = [&](const Facing& share, int other) {
      const WallFace& wall = walls[i];
      const double distance = distanceToSegment(point, wall.start + share.low_u * wall.direction,
                                                wall.start + share.high_u * wall.direction);
      if (share.gap > 1.0 || distance >= best_distance) return;
      best_distance = distance;
      best.wall = static_cast<int>(i);
      best.other_wall = other;
      best_share = share;
    };
    if (outside) consider({0.3, 0, walls[i].length}, -1);
    for (std::size_t j = 0; j < walls.size() && !outside; ++j) {
      const auto share = facing(walls[i], walls[j]);
      if (walls[j].room == wanted[1] && share) consider(*share, static_cast<int>(j));
    }
  }
  if (best.wall < 0) {
    refuse(plan, opening.name, "rooms",
           "no wall within 1 m of x_m, y_m stands between '" + opening.rooms[0] + "' and '" + opening.rooms[1] + "'");
  }
  const WallFace& wall = walls[best.wall];
  best.plan = &opening;
  best.depth = best_share.gap;
  const bool whole = best.depth == 0 || opening.width == 0;
  const double middle = wall.alongOf(point);
  best.low_u = whole ? best_share.low_u : middle - opening.width / 2;
  best.high_u = whole ? best_share.high_u : middle + opening.width / 2;
  if (best.low_u < best_share.low_u - kSame || best.high_u > best_share.high_u + kSame) {
    refuse(plan, opening.name, "width_m",
           base::brief(opening.width) + " does not fit into the wall there: the two rooms share " +
               base::brief(best_share.high_u - best_share.low_u) + " m");
  }
  double ceiling = std::min(wall.ceilingAt(best.low_u), wall.ceilingAt(best.high_u));
  const double floor = wall.floorAt((best.low_u + best.high_u) / 2);
  if (best.other_wall >= 0) {
    const WallFace& other = walls[best.other_wall];
    for (const double u : {best.low_u, best.high_u}) {
      const double there = other.alongOf(wall.start + u * wall.direction);
      ceiling = std::min(ceiling, other.ceilingAt(there));
      if (std::abs(other.floorAt(there) - wall.floorAt(u)) > 1e-6)
        refuse(plan, opening.name, "rooms", "their floors are not of one height there");
    }
  }
  best.low_z = floor + opening.sill;
  best.high_z = best.depth == 0 ? ceiling : floor + opening.sill + opening.height;
  if (best.high_z > ceiling + kSame) refuse(plan, opening.name, "height_m", "reaches above the ceiling");
  return best;
}

Building makeBuilding(const WorldPlan& plan) {
  Building building;
  building.rooms = makeRooms(plan);
  building.walls = makeWalls(plan, building.rooms);
  setSolids(building.walls);
  std::vector<FittedOpening> openings;
  for (const OpeningPlan& opening : plan.openings) {
    refuseUnknownMaterial(plan, opening.name, "material", opening.material);
    openings.push_back(fitOpening(plan, opening, building.rooms, building.walls));
    const FittedOpening& fitted = openings.back();
    const auto cut = [&](WallFace& wall, double low, double high) {
      const WallFace::Hole hole{low, high, fitted.low_z, fitted.high_z, opening.sill == 0};
      for (const WallFace::Hole& other : wall.holes) {
        if (hole.low_u < other.high_u && other.low_u < hole.high_u)
          refuse(plan, opening.name, "x_m", "overlaps another opening of the wall");
      }
      wall.holes.push_back(hole);
      std::sort(wall.holes.begin(), wall.holes.end(), [](const auto& a, const auto& b) { return a.low_u < b.low_u; });
    };
    WallFace& wall = building.walls[fitted.wall];
    cut(wall, fitted.low_u, fitted.high_u);
    if (fitted.other_wall < 0) continue;
    WallFace& other = building.walls[fitted.other_wall];
    cut(other, other.alongOf(wall.start + fitted.high_u * wall.direction),
        other.alongOf(wall.start + fitted.low_u * wall.direction));
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
