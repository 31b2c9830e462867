#include <omnimapper/sim_world/ObjectMaking.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "Arrangement.h"
#include "PlanChecks.h"
#include "WallThings.h"

namespace omnimapper::sim {

using Eigen::Vector2d;

namespace {

// The part of a level surface that objects are put on, in the frame of the piece.
struct Usable {
  Vector2d low, high;
};
Usable usableOf(const FurniturePlan& piece) {
  const SurfaceKind kind = findFurnitureShape(piece.shape)->kind;
  Vector2d half(piece.length / 2 - 0.03, piece.width / 2 - 0.03);
  if (piece.shape == "round_table") half *= 0.68;
  if (kind == SurfaceKind::shelf) half.x() -= 0.03;
  return {-half, half};
}

}  // namespace

std::optional<PlacePlan> Arrangement::freePlace(Top& top, const Vector2d& reach) {
  const Ring& area = top.usable_in_map;
  for (int attempt = 0; attempt < 40; ++attempt) {
    const Vector2d at = area[0] + random.uniform() * (area[1] - area[0]) + random.uniform() * (area[3] - area[0]);
    const double yaw = top.yaw + random.uniform(-0.4, 0.4);
    if (!isWithin(rectangle(at, reach.x(), reach.y(), yaw), area)) continue;
    const Ring outline = rectangle(at, reach.x() + 0.03, reach.y() + 0.03, yaw);
    if (std::any_of(top.taken.begin(), top.taken.end(), [&](const Ring& r) { return convexOverlap(r, outline); }))
      continue;
    top.taken.push_back(outline);
    return PlacePlan{at.x(), at.y(), yaw, top.surface};
  }
  return {};
}

std::optional<PlacePlan> Arrangement::freePlace(const std::string& rooms, const Vector2d& reach) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < tops_.size(); ++i) {
    if (tops_[i].room.compare(0, rooms.size(), rooms) == 0) order.push_back(i);
  }
  while (!order.empty()) {
    const auto pick = order.begin() + random.integer(0, static_cast<int>(order.size()) - 1);
    if (const auto place = freePlace(tops_[*pick], reach)) return place;
    order.erase(pick);
  }
  return {};
}

namespace {

// Height of the free space above a level part of a piece: below the next board, or without end [m].
double headroomAbove(const FurniturePlan& piece, const std::string& part) {
  const int count = boardsOf(piece);
  if (count < 2 || part == "board_" + std::to_string(count)) return std::numeric_limits<double>::infinity();
  const bool is_rack = piece.shape == "rack";
  const double outside = is_rack ? 0.14 : 0.08, thickness = is_rack ? 0.03 : 0.02;
  return (piece.height - outside) / (count - 1) - thickness;
}

// Outlines that keep objects, which freePlace() makes 1.5 cm larger on each side, out of the legs of a rack.
std::vector<Ring> legsThrough(const FurniturePlan& piece) {
  std::vector<Ring> legs;
  if (piece.shape != "rack") return legs;
  constexpr double kIn = 0.05, kSide = 0.02;  // from the border to the middle of a leg of 4 cm [m]
  const Eigen::Rotation2Dd turn(piece.yaw);
  for (const double end : {-1.0, 1.0}) {
    for (const double side : {-1.0, 1.0}) {
      const Vector2d middle(end * (piece.length / 2 - kIn), side * (piece.width / 2 - kIn));
      legs.push_back(rectangle(Vector2d(piece.x, piece.y) + turn * middle, kSide, kSide, piece.yaw));
    }
  }
  return legs;
}

}  // namespace

int boardsOf(const FurniturePlan& piece) {
  if (piece.shape != "shelf" && piece.shape != "rack") return 0;
  if (piece.boards > 0) return piece.boards;
  return piece.shape == "rack" ? 4 : std::max(2, static_cast<int>(std::lround(piece.height / 0.35)));
}

Arrangement::Top& Arrangement::topOf(const FurniturePlan& piece, const std::string& part) {
  const std::string surface = piece.name + "/" + part;
  for (Top& top : tops_) {
    if (top.surface == surface) return top;
  }
  const Usable usable = usableOf(piece);
  Top top{surface, "", {}, piece.yaw, legsThrough(piece), headroomAbove(piece, part)};
  const Eigen::Rotation2Dd turn(piece.yaw);
  for (const Vector2d& p : rectangle(usable.low, usable.high))
    top.usable_in_map.push_back(Vector2d(piece.x, piece.y) + turn * p);
  if (const auto room = roomAt(building_.rooms, {piece.x, piece.y})) top.room = building_.rooms[*room].name;
  tops_.push_back(std::move(top));
  return tops_.back();
}

void Arrangement::objectsOn(std::size_t piece, const std::string& part, int count,
                            const std::vector<std::string>& shapes) {
  Top& top = topOf(plan.furniture[piece], part);
  for (int i = 0; i < count; ++i) {
    ObjectSpec spec;
    spec.shape = shapes[random.integer(0, static_cast<int>(shapes.size()) - 1)];
    spec.name = spec.shape;
    spec.seed = seedOfObject(plan.seed, plan.objects.size());
    const Eigen::Vector3d reach = reachOf(makeObject(spec).body);
    const auto place = freePlace(top, reach.head<2>());
    if (!place || reach.z() >= top.headroom) continue;
    ObjectPlan object;
    object.name = newName(spec.shape);
    object.shape = spec.shape;
    object.place = *place;
    plan.objects.push_back(object);
  }
}

void Arrangement::carryObjects(double share) {
  if (options_.move_time < 0) return;
  for (std::size_t i = 0; i < plan.objects.size(); ++i) {
    ObjectPlan& object = plan.objects[i];
    if (!object.moves.empty() || !random.chance(share)) continue;
    ObjectSpec spec;
    spec.shape = object.shape;
    spec.name = object.name;
    spec.seed = seedOfObject(plan.seed, i);
    const Eigen::Vector3d reach = reachOf(makeObject(spec).body);
    const auto place = freePlace("", reach.head<2>());
    if (!place || place->on == object.place.on) continue;
    const auto top = std::find_if(tops_.begin(), tops_.end(), [&](const Top& t) { return t.surface == place->on; });
    if (reach.z() < top->headroom) object.moves.push_back({options_.move_time, place});
  }
}

void Arrangement::scatter(const std::string& room_name, double per_square_metre) {
  static const double factors[] = {0.3, 1.0, 2.2};
  const double area = doubleArea(roomNamed(room_name).outline) / 2;
  const int count = static_cast<int>(std::lround(area * per_square_metre * factors[static_cast<int>(clutter)]));
  for (int i = 0; i < count; ++i) {
    FurniturePlan pile;
    pile.length = random.uniform(0.4, 1.5);
    pile.width = random.uniform(0.35, 0.6);
    pile.height = random.uniform(0.3, 1.2);
    const int what = random.integer(0, 9);
    if (what == 0) {
      alongWall(room_name, "plant", Along::corner, 0);
    } else if (what == 1) {
      alongWall(room_name, "bin", Along::anywhere, 0);
    } else if (what <= 7 || clutter != ClutterLevel::high) {
      alongWall(room_name, "clutter", Along::anywhere, 0, pile);
    } else {
      inMiddle(room_name, "clutter", pile, 5);
    }
  }
}

std::optional<OnWallPlan> Arrangement::hang(const WallFace& wall, double u, double z, double width, double height) {
  constexpr double kMargin = 0.04, kDeep = 0.12;
  if (u - width / 2 < kMargin || u + width / 2 > wall.length - kMargin) return {};
  const double low = wall.floorAt(u) + z - height / 2, high = low + height;
  for (const WallFace::Hole& hole : wall.holes) {
    const bool beside = u + width / 2 + kMargin < hole.low_u || u - width / 2 - kMargin > hole.high_u;
    if (!beside && low < hole.high_z + kMargin && (hole.is_from_floor || high > hole.low_z - kMargin)) return {};
  }
  const Vector2d at = wall.start + u * wall.direction + kDeep / 2 * wall.inward();
  const Footprint before{
      "", rectangle(at, width + 2 * kMargin, kDeep, std::atan2(wall.direction.y(), wall.direction.x())), low, high};
  for (const auto* list : {&taken_, &hung_}) {
    if (std::any_of(list->begin(), list->end(), [&](const Footprint& other) { return overlap(before, other); }))
      return {};
  }
  hung_.push_back(before);
  return OnWallPlan{at.x(), at.y(), z};
}

std::optional<OnWallPlan> Arrangement::freeWall(const std::string& room_name, double share, double z, double width,
                                                double height) {
  const Ring& outline = roomNamed(room_name).outline;
  double around = 0;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    lengths.push_back((outline[(i + 1) % outline.size()] - outline[i]).norm());
    around += lengths.back();
  }
  // Tries places in steps from `share` on, once around the room.
  for (double travelled = 0; travelled < around; travelled += 0.1) {
    double u = std::fmod(share * around + travelled, around);
    std::size_t edge = 0;
    while (u > lengths[edge]) u -= lengths[edge++];
    const Vector2d along = (outline[(edge + 1) % outline.size()] - outline[edge]) / lengths[edge];
    const Vector2d at = outline[edge] + u * along;
    for (const WallFace& wall : building_.walls) {
      if ((wall.direction + along).norm() > 1e-6 || std::abs(wall.distanceTo(at)) > 1e-6) continue;
      if (wall.alongOf(at) < 0 || wall.alongOf(at) > wall.length) continue;
      if (u < width / 2 || u > lengths[edge] - width / 2) continue;
      if (const auto place = hang(wall, wall.alongOf(at), z, width, height)) return place;
    }
  }
  return {};
}

void Arrangement::signBeside(const OpeningPlan& door, const std::string& from, const std::string& room,
                             const std::vector<std::string>& lines) {
  const Vector2d middle(door.x, door.y);
  for (const WallFace& wall : building_.walls) {
    for (const WallFace::Hole& hole : wall.holes) {
      const double u = wall.alongOf(middle);
      if (u < hole.low_u || u > hole.high_u || std::abs(wall.distanceTo(middle)) > 0.5 || !hole.is_from_floor) continue;
      const auto inside = roomAt(building_.rooms, wall.start + u * wall.direction + 0.05 * wall.inward());
      if (!inside || building_.rooms[*inside].name != from) continue;
      for (const double beside : {hole.high_u + 0.32, hole.low_u - 0.32}) {
        const auto place = hang(wall, beside, usualHeight(signStyleOf(options_.sign_style)), 0.42, 0.3);
        if (!place) continue;
        SignPlan sign;
        sign.name = "sign_" + room;
        if (++counts_[sign.name] > 1) sign.name += "_" + std::to_string(counts_[sign.name]);
        sign.room = room;
        sign.lines = lines;
        sign.style = options_.sign_style;
        sign.at = *place;
        plan.signs.push_back(sign);
        return;
      }
    }
  }
}

void Arrangement::postersIn(const std::string& room, int count) {
  struct Kind {
    const char* name;
    double width, height, z;
  };
  static const Kind kinds[] = {{"poster", 0.6, 0.85, 1.5},
                               {"notice", 0.21, 0.297, 1.5},
                               {"poster", 0.5, 0.7, 1.55},
                               {"extinguisher", 0.2, 0.2, 1.6},
                               {"clock", 0.3, 0.3, 1.9}};
  for (int i = 0; i < count; ++i) {
    const Kind& kind = kinds[random.integer(0, 4)];
    const auto place = freeWall(room, random.uniform(), kind.z, kind.width, kind.height);
    if (!place) continue;
    plan.posters.push_back({newName(kind.name), kind.name, *place, kind.width, kind.height});
  }
}

}  // namespace omnimapper::sim
