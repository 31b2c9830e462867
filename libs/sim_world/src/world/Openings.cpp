#include "Openings.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/sim_world/Materials.h>

#include <array>
#include <cmath>

#include "PlanChecks.h"
#include "WallFaces.h"

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLeafThickness = 0.04;  // [m]
constexpr double kDoorwayDepth = 0.7;    // floor kept free before a door [m]
constexpr double kAtWall = 1.0;          // largest distance of an opening's point from its wall [m]
constexpr double kThickest = 1.0;        // largest thickness of the walls that an opening goes through [m]
constexpr double kOutsideWall = 0.3;     // thickness of a wall to the outside [m]
constexpr int kOutside = -1;

// Numbers of the two rooms that an opening joins.
std::array<int, 2> roomsOf(const WorldPlan& plan, const OpeningPlan& opening, const std::vector<Room>& rooms) {
  if (opening.rooms.size() != 2) refuse(plan, opening.name, "rooms", "must name the two rooms it joins");
  std::array<int, 2> numbers{kOutside, kOutside};
  for (const int side : {0, 1}) {
    if (side == 1 && opening.rooms[1] == "outside") continue;
    for (std::size_t i = 0; i < rooms.size(); ++i) {
      if (rooms[i].name == opening.rooms[side]) numbers[side] = static_cast<int>(i);
    }
    if (numbers[side] == kOutside)
      refuse(plan, opening.name, "rooms", "there is no room '" + opening.rooms[side] + "'");
  }
  return numbers;
}

// The walls nearest to the opening's place that stand between its rooms, and the interval that they share.
struct WallPair {
  int wall = -1, other_wall = kOutside;
  Facing share;
};
WallPair wallsAt(const WorldPlan& plan, const OpeningPlan& opening, const std::array<int, 2>& between,
                 const std::vector<WallFace>& walls) {
  const Vector2d point(opening.x, opening.y);
  WallPair best;
  double best_distance = kAtWall;
  const auto consider = [&](const WallPair& pair) {
    const WallFace& wall = walls[pair.wall];
    const double distance = distanceToSegment(point, wall.start + pair.share.low_u * wall.direction,
                                              wall.start + pair.share.high_u * wall.direction);
    if (pair.share.gap > kThickest || distance >= best_distance) return;
    best_distance = distance;
    best = pair;
  };
  for (int i = 0; i < static_cast<int>(walls.size()); ++i) {
    if (walls[i].room != between[0]) continue;
    if (between[1] == kOutside) consider({i, kOutside, {kOutsideWall, 0, walls[i].length}});
    for (int j = 0; j < static_cast<int>(walls.size()) && between[1] != kOutside; ++j) {
      if (walls[j].room != between[1]) continue;
      if (const auto share = facing(walls[i], walls[j])) consider({i, j, *share});
    }
  }
  if (best.wall < 0) {
    refuse(plan, opening.name, "rooms",
           "no wall within 1 m of x_m, y_m stands between '" + opening.rooms[0] + "' and '" + opening.rooms[1] + "'");
  }
  return best;
}

// Height of the ceiling over the opening, the lower one of both rooms.
double ceilingOver(const WorldPlan& plan, const FittedOpening& opening, const std::vector<WallFace>& walls) {
  const WallFace& wall = walls[opening.wall];
  double ceiling = std::min(wall.ceilingAt(opening.low_u), wall.ceilingAt(opening.high_u));
  if (opening.other_wall == kOutside) return ceiling;
  const WallFace& other = walls[opening.other_wall];
  for (const double u : {opening.low_u, opening.high_u}) {
    const double there = other.alongOf(wall.start + u * wall.direction);
    ceiling = std::min(ceiling, other.ceilingAt(there));
    if (std::abs(other.floorAt(there) - wall.floorAt(u)) > 1e-6)
      refuse(plan, opening.plan->name, "rooms", "the floors of the two rooms do not have the same height there");
  }
  return ceiling;
}

// A point of the opening: u along the wall, `depth` into its solid, at height z.
Vector3d inside(const WallFace& wall, double u, double depth, double z) {
  const Vector2d p = wall.start + u * wall.direction - depth * wall.inward();
  return {p.x(), p.y(), z};
}

// The sides of the hole through the wall, and the floor or sill in it.
Body makeFrame(const FittedOpening& opening, const WallFace& wall) {
  const OpeningPlan& plan = *opening.plan;
  const bool is_window = plan.kind == OpeningPlan::Kind::window, is_floor = plan.sill == 0;
  const SurfaceKind kind = is_window ? SurfaceKind::window : SurfaceKind::door;
  const NamedMaterial frame_material = materialNamed(plan.material);
  MeshBuilder builder(plan.name);
  builder.layout(frame_material.layout);
  const double left = opening.low_u, right = opening.high_u, far = opening.depth, high = opening.high_z;
  const double low_left = is_floor ? wall.floorAt(left) : opening.low_z,
               low_right = is_floor ? wall.floorAt(right) : opening.low_z;
  const auto at = [&](double u, double depth, double z) { return inside(wall, u, depth, z); };
  const int frame = builder.addSurface("frame", kind, frame_material.material);
  builder.addFace(frame, {at(left, 0, low_left), at(left, far, low_left), at(left, far, high), at(left, 0, high)});
  builder.addFace(frame,
                  {at(right, far, low_right), at(right, 0, low_right), at(right, 0, high), at(right, far, high)});
  builder.addFace(frame, {at(left, far, high), at(right, far, high), at(right, 0, high), at(left, 0, high)});
  builder.addPlane(
      is_floor ? "threshold" : "sill", is_floor ? SurfaceKind::floor : kind, frame_material.material,
      {at(left, 0, low_left), at(right, 0, low_right), at(right, far, low_right), at(left, far, low_left)});
  if (is_window) {
    builder.addPlane("pane", kind, materialNamed("glass").material,
                     {at(left, far / 2, low_left), at(right, far / 2, low_right), at(right, far / 2, high),
                      at(left, far / 2, high)});
  }
  Body body = builder.build();
  if (!is_window) body.surfaces[frame].is = surfaces::SurfaceClass::door_frame;
  return body;
}

// The opening as people go or look through it.
surfaces::Opening openingOf(const FittedOpening& fitted, const WallFace& wall) {
  const OpeningPlan& plan = *fitted.plan;
  surfaces::Opening opening;
  opening.name = plan.name;
  opening.kind = plan.kind == OpeningPlan::Kind::door      ? surfaces::Opening::Kind::door
                 : plan.kind == OpeningPlan::Kind::passage ? surfaces::Opening::Kind::passage
                                                           : surfaces::Opening::Kind::window;
  opening.rooms = {plan.rooms[0], plan.rooms[1]};
  const double low_left = plan.sill > 0 ? fitted.low_z : wall.floorAt(fitted.low_u),
               low_right = plan.sill > 0 ? fitted.low_z : wall.floorAt(fitted.high_u);
  opening.rectangle = {wall.at(fitted.low_u, low_left), wall.at(fitted.high_u, low_right),
                       wall.at(fitted.high_u, fitted.high_z), wall.at(fitted.low_u, fitted.high_z)};
  if (plan.kind != OpeningPlan::Kind::door || plan.leaf == OpeningPlan::Leaf::none) return opening;
  const bool is_closed = plan.leaf == OpeningPlan::Leaf::closed;
  opening.leaf = is_closed ? surfaces::Opening::Leaf::closed : surfaces::Opening::Leaf::open;
  opening.leaf_angle = is_closed ? 0 : plan.leaf_angle;
  opening.leaf_body = plan.name + "_leaf";
  return opening;
}

// A leaf turns about an edge of the opening on the side of the first room. Its frame: origin at the hinge on the floor,
// x along the leaf, z up.
Body makeLeaf(const FittedOpening& opening, const WallFace& wall, double angle) {
  const OpeningPlan& plan = *opening.plan;
  const double width = opening.high_u - opening.low_u, height = opening.high_z - opening.low_z - 0.005;
  const Vector3d hinge = inside(wall, plan.hinge_right ? opening.high_u : opening.low_u, 0, opening.low_z + 0.005);
  const double along = std::atan2(wall.direction.y(), wall.direction.x());
  const double yaw = plan.hinge_right ? along + M_PI + angle : along - angle;
  MeshBuilder builder(plan.name + "_leaf",
                      Track({Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitZ())), hinge}));
  const NamedMaterial material = materialNamed(plan.material);
  const double low_y = plan.hinge_right ? -kLeafThickness : 0;
  builder.layout(material.layout);
  builder.addBoxOfPlanes("", SurfaceKind::door, material.material, {0, low_y, 0},
                         {width, low_y + kLeafThickness, height});
  return builder.build();
}

Ring outlineOf(const Body& leaf) {
  Vector3d low = leaf.vertices_in_body.front(), high = low;
  for (const Vector3d& p : leaf.vertices_in_body) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const geometry::Se3 map_from_body = *leaf.track.at(0);
  Ring ring;
  for (const Vector2d& p : rectangle(low.head<2>(), high.head<2>())) {
    ring.emplace_back((map_from_body * Vector3d(p.x(), p.y(), 0)).head<2>());
  }
  return ring;
}

}  // namespace

FittedOpening fitOpening(const WorldPlan& plan, const OpeningPlan& opening, const std::vector<Room>& rooms,
                         const std::vector<WallFace>& walls) {
  const WallPair pair = wallsAt(plan, opening, roomsOf(plan, opening, rooms), walls);
  const WallFace& wall = walls[pair.wall];
  FittedOpening fitted;
  fitted.plan = &opening;
  fitted.wall = pair.wall;
  fitted.other_wall = pair.other_wall;
  fitted.depth = pair.share.gap;
  const bool whole = fitted.depth == 0 || opening.width == 0;
  const double middle = wall.alongOf({opening.x, opening.y});
  fitted.low_u = whole ? pair.share.low_u : middle - opening.width / 2;
  fitted.high_u = whole ? pair.share.high_u : middle + opening.width / 2;
  if (fitted.low_u < pair.share.low_u - kSamePlace || fitted.high_u > pair.share.high_u + kSamePlace) {
    refuse(plan, opening.name, "width_m",
           base::brief(opening.width) + " does not fit into the wall there: the two rooms share " +
               base::brief(pair.share.high_u - pair.share.low_u) + " m");
  }
  const double ceiling = ceilingOver(plan, fitted, walls);
  fitted.low_z = wall.floorAt((fitted.low_u + fitted.high_u) / 2) + opening.sill;
  fitted.high_z = fitted.depth == 0 ? ceiling : fitted.low_z + opening.height;
  if (fitted.high_z > ceiling + kSamePlace) refuse(plan, opening.name, "height_m", "reaches above the ceiling");
  return fitted;
}

void addOpening(const FittedOpening& opening, const std::vector<WallFace>& walls, Building& building) {
  const OpeningPlan& plan = *opening.plan;
  const WallFace& wall = walls[opening.wall];
  building.openings.push_back(openingOf(opening, wall));
  if (opening.depth > 0) building.bodies.push_back(makeFrame(opening, wall));
  const bool has_leaf = plan.kind == OpeningPlan::Kind::door && plan.leaf != OpeningPlan::Leaf::none;
  const bool is_closed = has_leaf && plan.leaf == OpeningPlan::Leaf::closed;
  if (has_leaf) {
    building.bodies.push_back(makeLeaf(opening, wall, is_closed ? 0 : plan.leaf_angle));
    const Ring outline = outlineOf(building.bodies.back());
    building.obstacles.push_back(outline);
    building.furniture.push_back({plan.name, outline, opening.low_z, opening.high_z});
  }
  if (plan.sill > 0) return;
  const double before = has_leaf && !is_closed ? std::max(kDoorwayDepth, plan.width + 0.05) : kDoorwayDepth;
  const auto corner = [&](double u, double depth) { return Vector2d(inside(wall, u, depth, 0).head<2>()); };
  building.doorways.push_back({corner(opening.low_u, -before), corner(opening.high_u, -before),
                               corner(opening.high_u, opening.depth + kDoorwayDepth),
                               corner(opening.low_u, opening.depth + kDoorwayDepth)});
}

}  // namespace omnimapper::sim
