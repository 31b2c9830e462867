#include "Arrangement.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "PlanChecks.h"
#include "RoomPaths.h"
#include "StandingThings.h"

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;

Ring local(const FurniturePlan& piece, const Vector2d& low, const Vector2d& high) {
  const Eigen::Rotation2Dd turn(piece.yaw);
  Ring ring;
  for (const Vector2d& p : rectangle(low, high)) ring.push_back(Vector2d(piece.x, piece.y) + turn * p);
  return ring;
}

}  // namespace

Arrangement::Arrangement(const WorldOptions& options, const std::string& file)
    : random(static_cast<std::uint64_t>(options.seed), {0x9e0}), clutter(options.clutter), options_(options) {
  plan.file = file;
  plan.seed = static_cast<std::uint64_t>(options.seed);
  plan.wear = options.wear;
}

RoomPlan& Arrangement::room(const std::string& name, const std::string& kind, const Vector2d& low,
                            const Vector2d& high) {
  RoomPlan room;
  room.name = name;
  room.kind = kind;
  room.outline = rectangle(low, high);
  plan.rooms.push_back(room);
  return plan.rooms.back();
}

OpeningPlan& Arrangement::opening(OpeningPlan::Kind kind, const std::string& first, const std::string& second,
                                  const Vector2d& near) {
  static const char* const names[] = {"door_", "passage_", "window_"};
  OpeningPlan opening;
  opening.kind = kind;
  opening.name = names[static_cast<int>(kind)] + std::to_string(plan.openings.size() + 1);
  opening.rooms = {first, second};
  opening.x = near.x();
  opening.y = near.y();
  plan.openings.push_back(opening);
  return plan.openings.back();
}

void Arrangement::window(const std::string& room, const Vector2d& near, double width) {
  OpeningPlan& window = opening(OpeningPlan::Kind::window, room, "outside", near);
  window.width = width;
  window.sill = 0.9;
  window.height = 1.3;
  window.material = "enamel_white";
}

void Arrangement::raise() {
  for (RoomPlan& room : plan.rooms) {
    if (room.kind == "corridor" && !options_.hall_wall.empty()) room.wall = options_.hall_wall;
  }
  building_ = makeBuilding(plan);
  taken_ = building_.furniture;
  doorways_ = building_.doorways;
}

bool Arrangement::has(const std::string& room) const {
  return std::any_of(plan.rooms.begin(), plan.rooms.end(), [&](const RoomPlan& r) { return r.name == room; });
}

const Room& Arrangement::roomNamed(const std::string& name) const {
  return *std::find_if(building_.rooms.begin(), building_.rooms.end(), [&](const Room& r) { return r.name == name; });
}

std::string Arrangement::newName(const std::string& shape) {
  return shape + "_" + std::to_string(++counts_[shape]);
}

bool Arrangement::fits(const Footprint& footprint, const Ring& clear, const Room& room) const {
  if (!isWithin(footprint.outline_in_map, room.outline)) return false;
  const bool is_low = footprint.low_z < room.floorAt(footprint.outline_in_map.front()) + 1.3;
  for (const Ring& ring : doorways_) {
    if (is_low && convexOverlap(ring, footprint.outline_in_map)) return false;
  }
  for (const Footprint& other : taken_) {
    if (overlap(footprint, other)) return false;
    if (!clear.empty() && other.low_z < 0.5 && convexOverlap(clear, other.outline_in_map)) return false;
  }
  return clear.empty() || isWithin(clear, room.outline);
}

// Whether a robot can still get from each doorway of the room to all others, and to nearly all free floor.
bool Arrangement::keepsPathsOpen(const Footprint& footprint, const Room& room) const {
  const Bounds bounds = boundsOf(room.outline);
  if ((bounds.high - bounds.low).prod() > 400) return true;  // a ground or a hall always leaves a path
  RoomPaths paths(room, doorways_);
  for (const Footprint& other : taken_) {
    if (other.low_z < room.floorAt(room.outline.front()) + 1.3) paths.block(other.outline_in_map);
  }
  paths.block(footprint.outline_in_map);
  return paths.areOpen();
}

std::size_t Arrangement::accept(FurniturePlan piece, const Footprint& footprint, const Ring& clear) {
  piece.name = newName(piece.shape);
  taken_.push_back(footprint);
  taken_.back().name = piece.name;
  if (!clear.empty()) fronts_.push_back(clear);
  plan.furniture.push_back(piece);
  return plan.furniture.size() - 1;
}

std::optional<std::size_t> Arrangement::place(FurniturePlan piece, double clear) {
  const FurniturePlan sized = withUsualSize(piece, *findFurnitureShape(piece.shape));
  const auto number = roomAt(building_.rooms, {sized.x, sized.y});
  if (!number) return {};
  const Room& room = building_.rooms[*number];
  const Footprint footprint = footprintOf(sized, room.floorAt({sized.x, sized.y}));
  Ring front;
  if (clear > 0) {
    front = local(sized, {-sized.length / 2, -sized.width / 2 - clear}, {sized.length / 2, -sized.width / 2});
  }
  if (!fits(footprint, front, room)) return {};
  const bool is_chair = findFurnitureShape(sized.shape)->kind == SurfaceKind::chair && sized.length < 0.8;
  for (const Ring& ring : fronts_) {
    if (!is_chair && footprint.low_z < 1.3 && sized.height > 0.43 && convexOverlap(ring, footprint.outline_in_map))
      return {};
  }
  if (footprint.low_z < room.floorAt({sized.x, sized.y}) + 1.3 && !room.is_outdoors && !keepsPathsOpen(footprint, room))
    return {};
  return accept(sized, footprint, front);
}

std::optional<std::size_t> Arrangement::alongWall(const std::string& room_name, const std::string& shape, Along along,
                                                  double clear, FurniturePlan piece) {
  piece.shape = shape;
  piece = withUsualSize(piece, *findFurnitureShape(shape));
  const Room& room = roomNamed(room_name);
  struct Candidate {
    double cost;
    Vector2d at;
    double yaw;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    const Vector2d &a = room.outline[i], &b = room.outline[(i + 1) % room.outline.size()];
    const double length = (b - a).norm(), half = piece.length / 2;
    const Vector2d direction = (b - a) / length, inward(-direction.y(), direction.x());
    const double yaw = std::atan2(inward.y(), inward.x()) + M_PI / 2;
    const double wall_cost = random.uniform(0, 1);
    for (double u = half + 0.03; u <= length - half - 0.03; u += 0.1) {
      const Vector2d at = a + u * direction + (piece.width / 2 + 0.02) * inward;
      if (hidesOpening(a + u * direction, direction, inward, piece)) continue;
      const double to_end = std::min(u - half, length - half - u);
      const double cost = along == Along::corner   ? wall_cost + 3 * to_end
                          : along == Along::middle ? wall_cost + std::abs(u - length / 2) - 0.3 * length
                                                   : random.uniform(0, 1);
      candidates.push_back({cost, at, yaw});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& x, const auto& y) { return x.cost < y.cost; });
  for (const Candidate& candidate : candidates) {
    piece.x = candidate.at.x();
    piece.y = candidate.at.y();
    piece.yaw = std::remainder(candidate.yaw, 2 * M_PI);
    if (const auto number = place(piece, clear)) return number;
  }
  return {};
}

bool Arrangement::hidesOpening(const Vector2d& at_wall, const Vector2d& direction, const Vector2d& inward,
                               const FurniturePlan& piece) const {
  for (const WallFace& wall : building_.walls) {
    if ((wall.inward() - inward).norm() > 1e-6 || std::abs(wall.distanceTo(at_wall)) > 1e-6) continue;
    const double u = wall.alongOf(at_wall), half = piece.length / 2 * std::abs(wall.direction.dot(direction));
    for (const WallFace::Hole& hole : wall.holes) {
      const double top = wall.floorAt(std::clamp(u, 0.0, wall.length)) + piece.z + piece.height;
      if (u - half < hole.high_u && u + half > hole.low_u && (hole.is_from_floor || top > hole.low_z)) return true;
    }
  }
  return false;
}

std::optional<std::size_t> Arrangement::inMiddle(const std::string& room_name, const std::string& shape,
                                                 FurniturePlan piece, double spread) {
  piece.shape = shape;
  piece = withUsualSize(piece, *findFurnitureShape(shape));
  const Bounds bounds = boundsOf(roomNamed(room_name).outline);
  const Vector2d size = bounds.high - bounds.low, centre = (bounds.low + bounds.high) / 2;
  const bool lengthwise = size.x() > size.y();
  std::vector<std::pair<double, Vector2d>> candidates;
  for (double x = -size.x() / 2 + 0.6; x <= size.x() / 2 - 0.6; x += 0.2) {
    for (double y = -size.y() / 2 + 0.6; y <= size.y() / 2 - 0.6; y += 0.2)
      candidates.emplace_back(std::hypot(x, y) + random.uniform(0, spread), centre + Vector2d(x, y));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  for (const auto& [cost, at] : candidates) {
    piece.x = at.x();
    piece.y = at.y();
    piece.yaw = lengthwise ? 0 : M_PI / 2;
    if (const auto number = place(piece)) return number;
  }
  return {};
}

std::optional<std::size_t> Arrangement::beside(std::size_t piece, const std::string& shape, const Vector2d& in_piece,
                                               double turn, FurniturePlan sized) {
  const FurniturePlan& base = plan.furniture[piece];
  const Vector2d at = Vector2d(base.x, base.y) + Eigen::Rotation2Dd(base.yaw) * in_piece;
  sized.shape = shape;
  sized.x = at.x();
  sized.y = at.y();
  sized.yaw = std::remainder(base.yaw + turn, 2 * M_PI);
  return place(sized);
}

void Arrangement::chairsAround(std::size_t table, const std::string& shape, int count) {
  const double length = plan.furniture[table].length, width = plan.furniture[table].width;
  const int on_side = std::max(1, static_cast<int>(length / 0.65));
  std::vector<std::pair<Vector2d, double>> seats;
  for (int i = 0; i < on_side; ++i) {
    const double x = (i + 0.5) * length / on_side - length / 2;
    for (const double side : {-1.0, 1.0}) {
      const double out = width / 2 + random.uniform(-0.02, 0.15);
      seats.emplace_back(Vector2d(x + random.uniform(-0.05, 0.05), side * out),
                         (side > 0 ? 0 : M_PI) + random.uniform(-0.2, 0.2));
    }
  }
  for (std::size_t i = 0; i < seats.size() && static_cast<int>(i) < count; ++i)
    beside(table, shape, seats[i].first, seats[i].second);
}

}  // namespace omnimapper::sim
