#include "StandingThings.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/sim_world/Furniture.h>

#include <cmath>

namespace omnimapper::sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kHalfPerson = 0.15;  // space that a person fills to each side of its path [m]

}  // namespace

Footprint footprintOf(const FurniturePlan& sized, double floor_z) {
  const SurfaceKind kind = findFurnitureShape(sized.shape)->kind;
  const double low = floor_z + sized.z, high = low + sized.height;
  Footprint footprint{sized.name, rectangle({sized.x, sized.y}, sized.length, sized.width, sized.yaw), low, high};
  if (kind == SurfaceKind::table) footprint.low_z = high - 0.05;
  if (kind == SurfaceKind::chair && sized.height > 0.85) footprint.high_z = low + 0.5;
  return footprint;
}

StandingSpace::StandingSpace(const WorldPlan& plan, const Building& building) : plan_(plan), building_(building) {
  for (const Footprint& leaf : building.furniture) taken_.push_back({leaf});
}

void StandingSpace::take(const std::string& name, const std::string& key, Taken taken, const std::string& support) {
  for (const Taken& other : taken_) {
    if (other.footprint.name == support || other.end <= taken.begin || taken.end <= other.begin) continue;
    if (!overlap(taken.footprint, other.footprint)) continue;
    const std::string when = key == "moves" ? "from " + base::brief(std::max(taken.begin, other.begin)) + " s on " : "";
    refuse(plan_, name, key, when + "stands in '" + other.footprint.name + "'");
  }
  taken_.push_back(std::move(taken));
}

geometry::Se3 StandingSpace::put(const FurniturePlan& sized, bool follows_slope) {
  const Vector2d middle(sized.x, sized.y);
  const auto number = roomAt(building_.rooms, middle);
  if (!number) refuse(plan_, sized.name, "x_m", "x_m, y_m lies in no room");
  const Room& room = building_.rooms[*number];
  const double floor = room.floorAt(middle);
  const Footprint footprint = footprintOf(sized, floor);
  if (!room.is_outdoors && !isWithin(footprint.outline_in_map, room.outline))
    refuse(plan_, sized.name, "x_m", "stands in a wall of '" + room.name + "'");
  if (!room.is_outdoors && sized.z + sized.height > room.height + kFloorTolerance)
    refuse(plan_, sized.name, "height_m", "reaches above the ceiling of '" + room.name + "'");
  take(sized.name, "x_m", {footprint}, "");
  Eigen::Quaterniond turn(Eigen::AngleAxisd(sized.yaw, Vector3d::UnitZ()));
  if (follows_slope) {
    const Vector3d up = Vector3d(-room.slope.x(), -room.slope.y(), 1).normalized();
    turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up) * turn;
  }
  return {turn, {sized.x, sized.y, floor + sized.z}};
}

void StandingSpace::addSupports(const Body& body) {
  const auto pose = body.track.at(0);
  if (!pose) return;
  for (const Surface& surface : body.surfaces) {
    if (!surface.face || (*pose * surface.face->plane_in_body).normal.z() < 1 - 1e-9) continue;
    Support support{surface.name, {}, 0};
    for (const Vector3d& p : surface.face->outline_in_body) {
      const Vector3d in_map = *pose * p;
      support.outline_in_map.push_back(in_map.head<2>());
      support.z = in_map.z();
    }
    supports_.push_back(std::move(support));
  }
}

geometry::Se3 StandingSpace::poseOf(const std::string& name, const std::string& key, const PlacePlan& place,
                                    const Vector3d& extents) const {
  const Vector2d middle(place.x, place.y);
  const Ring outline = rectangle(middle, extents.x(), extents.y(), place.yaw);
  double z = 0;
  if (place.on.empty()) {
    const auto room = roomAt(building_.rooms, middle);
    if (!room)
      refuse(plan_, name, key, "the place " + base::brief(place.x) + " " + base::brief(place.y) + " lies in no room");
    if (!isWithin(outline, building_.rooms[*room].outline))
      refuse(plan_, name, key, "stands in a wall of '" + building_.rooms[*room].name + "'");
    z = building_.rooms[*room].floorAt(middle);
  } else {
    const Support* support = nullptr;
    std::vector<std::string> names;
    for (const Support& candidate : supports_) {
      names.push_back(candidate.name);
      if (candidate.name == place.on) support = &candidate;
    }
    const bool is_move = key == "moves";
    if (!support) {
      const std::string near = base::nearestName(place.on, names);
      refuse(plan_, name, is_move ? key : "on",
             "no level surface is called '" + place.on + "'" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
    }
    if (!isWithin(outline, support->outline_in_map))
      refuse(plan_, name, key, "reaches over the rim of '" + place.on + "'");
    z = support->z;
  }
  return {Eigen::Quaterniond(Eigen::AngleAxisd(place.yaw, Vector3d::UnitZ())), {place.x, place.y, z}};
}

Track StandingSpace::trackOf(const std::string& name, const PlacePlan& place, const std::vector<MovePlan>& moves,
                             const Vector3d& extents) {
  std::vector<Track::Place> places{{0, {}}};
  for (const MovePlan& move : moves) {
    if (move.time <= places.back().time) {
      refuse(plan_, name, "moves",
             "times must increase, from above 0: " + base::brief(move.time) + " comes after " +
                 base::brief(places.back().time));
    }
    places.push_back({move.time, {}});
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string key = i == 0 ? "x_m" : "moves";
    const PlacePlan* at = i == 0 ? &place : moves[i - 1].place ? &*moves[i - 1].place : nullptr;
    if (!at) continue;
    const geometry::Se3 pose = poseOf(name, key, *at, extents);
    const double z = pose.translation.z();
    Taken taken{{name, rectangle({at->x, at->y}, extents.x(), extents.y(), at->yaw), z, z + extents.z()}};
    if (i > 0) taken.begin = places[i].time;
    if (i + 1 < places.size()) taken.end = places[i + 1].time;
    take(name, key, std::move(taken), at->on.substr(0, at->on.rfind('/')));  // a board lies inside of its shelf
    places[i].map_from_body = pose;
  }
  if (places.size() == 1) return Track(*places.front().map_from_body);
  return {Track::Kind::steps, std::move(places)};
}

void StandingSpace::refuseBlocked(const std::string& person, const std::string& stretch, const Taken& swept) const {
  for (const Taken& other : taken_) {
    if (other.end <= swept.begin || swept.end <= other.begin || !overlap(swept.footprint, other.footprint)) continue;
    refuse(plan_, person, "path", stretch + " leads through '" + other.footprint.name + "'");
  }
  for (const Ring& solid : building_.obstacles) {
    if (convexOverlap(swept.footprint.outline_in_map, solid))
      refuse(plan_, person, "path", stretch + " leads through a wall");
  }
}

void StandingSpace::refuseBlockedPath(const PersonSpec& person) const {
  const auto format = [](const Vector2d& p) { return "(" + base::brief(p.x()) + ", " + base::brief(p.y()) + ")"; };
  const auto& waypoints = person.waypoints;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const bool is_last = i + 1 == waypoints.size();
    const Vector2d from = waypoints[i].in_map, to = is_last ? from : waypoints[i + 1].in_map, leg = to - from;
    Taken swept{
        {person.name,
         rectangle((from + to) / 2, leg.norm() + 2 * kHalfPerson, 2 * kHalfPerson, std::atan2(leg.y(), leg.x())),
         person.floor_z, person.floor_z + person.height}};
    if (i > 0) swept.begin = waypoints[i].time;
    if (!is_last) swept.end = waypoints[i + 1].time;
    refuseBlocked(person.name, "from " + format(from) + " to " + format(to) + " it", swept);
  }
}

}  // namespace omnimapper::sim
