#include "StandingThings.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/sim_world/Furniture.h>

#include <algorithm>
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

const StandingSpace::Taken* StandingSpace::takenBy(const std::string& name, double time) const {
  for (const Taken& taken : taken_) {
    if (taken.footprint.name == name && taken.begin <= time && time < taken.end) return &taken;
  }
  return nullptr;
}

std::vector<std::string> StandingSpace::carriersOf(const std::string& support, double time) const {
  std::vector<std::string> carriers;
  for (const Support* next = supports_.find(support); next;) {
    carriers.push_back(next->carrier);
    const Taken* taken = takenBy(next->carrier, time);
    next = taken ? supports_.find(taken->on) : nullptr;
  }
  return carriers;
}

std::vector<std::string> StandingSpace::ridersOf(const std::string& item, double time) const {
  const double before = std::nextafter(time, -std::numeric_limits<double>::infinity());
  std::vector<std::string> riders;
  for (const Taken& taken : taken_) {
    if (taken.begin > before || before >= taken.end) continue;
    const std::vector<std::string> carriers = carriersOf(taken.on, before);
    if (std::find(carriers.begin(), carriers.end(), item) != carriers.end()) riders.push_back(taken.footprint.name);
  }
  return riders;
}

void StandingSpace::take(const Stage& stage, Taken taken) {
  const std::vector<std::string> carriers = carriersOf(taken.on, std::max(stage.begin, taken.begin));
  for (const Taken& other : taken_) {
    const bool carries = std::find(carriers.begin(), carriers.end(), other.footprint.name) != carriers.end();
    if (carries || other.end <= taken.begin || taken.end <= other.begin) continue;
    if (!overlap(taken.footprint, other.footprint)) continue;
    const double from = std::max(taken.begin, other.begin);
    const std::string when = std::isfinite(from) ? "from " + base::brief(from) + " s on " : "";
    refuse(plan_, stage.section, stage.key, when + "stands in '" + other.footprint.name + "'");
  }
  for (const std::string& carrier : carriers) {
    if (!supports_.reachesInto(carrier, taken.footprint)) continue;
    refuse(plan_, stage.section, stage.key,
           "does not fit on '" + taken.on + "': '" + carrier + "' has other parts in its place of " +
               base::brief(taken.footprint.high_z - taken.footprint.low_z) + " m above it; make it lower or move it");
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
  take({0, 0, nullptr, sized.name, "x_m"}, {footprint});
  Eigen::Quaterniond turn(Eigen::AngleAxisd(sized.yaw, Vector3d::UnitZ()));
  if (follows_slope) {
    const Vector3d up = Vector3d(-room.slope.x(), -room.slope.y(), 1).normalized();
    turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up) * turn;
  }
  return {turn, {sized.x, sized.y, floor + sized.z}};
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
