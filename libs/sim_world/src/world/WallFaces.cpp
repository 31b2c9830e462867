#include "WallFaces.h"

#include <algorithm>

namespace omnimapper::sim {

using Eigen::Vector2d;

namespace {

void setSolids(std::vector<WallFace>& walls) {
  for (WallFace& wall : walls) {
    for (const WallFace& other : walls) {
      const auto shared = facing(wall, other);
      if (shared && shared->gap > kSamePlace) wall.solid = std::min(wall.solid, shared->gap);
    }
  }
}

bool continues(const WallFace& a, const WallFace& b) {
  const double rise_a = (a.floor_end - a.floor_start) / a.length, rise_b = (b.floor_end - b.floor_start) / b.length;
  return (a.direction - b.direction).norm() < kSamePlace && (a.end() - b.start).norm() < kSamePlace &&
         std::abs(a.floor_end - b.floor_start) < kSamePlace && std::abs(a.ceiling_end - b.ceiling_start) < kSamePlace &&
         std::abs(rise_a - rise_b) < kSamePlace;
}

}  // namespace

Eigen::Vector3d WallFace::at(double u, double z) const {
  const Vector2d p = start + u * direction;
  return {p.x(), p.y(), z};
}

std::vector<WallFace> makeWalls(const std::vector<Room>& rooms) {
  std::vector<WallFace> walls;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const Room& room = rooms[i];
    if (room.is_outdoors) continue;
    for (std::size_t k = 0; k < room.outline.size(); ++k) {
      // The room lies to the left of its outline, so the end of the edge is on the left of somebody who looks at the
      // wall.
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
  setSolids(walls);
  return walls;
}

std::optional<Facing> facing(const WallFace& a, const WallFace& b) {
  if ((a.direction + b.direction).norm() > kSamePlace) return {};
  const double gap = -a.distanceTo(b.start);
  if (gap < -kSamePlace) return {};
  const double low = std::max(0.0, a.alongOf(b.end())), high = std::min(a.length, a.alongOf(b.start));
  if (high - low <= kFloorTolerance) return {};
  return Facing{std::max(0.0, gap), low, high};
}

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
      if (hole.low_u < from - kSamePlace || hole.high_u > to + kSamePlace) continue;
      hole.low_u -= from;
      hole.high_u -= from;
      piece.holes.push_back(hole);
    }
    pieces.push_back(std::move(piece));
  };
  for (const WallFace::Hole& hole : wall.holes) {
    const double ceiling = std::min(wall.ceilingAt(hole.low_u), wall.ceilingAt(hole.high_u));
    if (!hole.is_from_floor || hole.high_z < ceiling - kSamePlace) continue;
    add(hole.low_u);
    from = hole.high_u;
  }
  add(wall.length);
  return pieces;
}

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
      j = static_cast<std::size_t>(-1);  // begins again, because the longer wall may go on
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
  // An opening at an end of the wall leaves corners on a straight line, which are removed.
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

}  // namespace omnimapper::sim
