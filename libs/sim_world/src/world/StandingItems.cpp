// The places of items over time (StandingSpace::trackOf).
#include <omnimapper/base/Config.h>
#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <cmath>

#include "StandingThings.h"

namespace omnimapper::sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Extents along the axes of the frame that the outline is in.
std::string sizeOf(const Ring& outline) {
  const Bounds bounds = boundsOf(outline);
  const Vector2d size = bounds.high - bounds.low;
  return base::brief(size.x(), 3) + " x " + base::brief(size.y(), 3) + " m";
}

}  // namespace

std::vector<StandingSpace::Stage> StandingSpace::stagesOf(const Item& item) const {
  Stage first;
  first.place = &item.place;
  first.section = item.name;
  first.key = "x_m";
  std::vector<Stage> stages{first};
  for (const MovePlan& move : item.moves) {
    Stage& before = stages.back();
    Stage stage;
    stage.begin = move.time;
    stage.place = move.place ? &*move.place : nullptr;
    stage.section = move.person.empty() ? item.name : move.person;
    stage.key = move.person.empty() ? "moves" : "carrying";
    if (move.time <= before.begin) {
      refuse(
          plan_, stage.section, stage.key,
          "times must increase, from above 0: " + base::brief(move.time) + " comes after " + base::brief(before.begin));
    }
    before.end = move.time;
    stages.push_back(std::move(stage));
  }
  return stages;
}

PlacePlan StandingSpace::slidAgainst(const Item& item) const {
  PlacePlan place = item.place;
  const Taken* neighbour = takenBy(item.touching, 0);
  if (!neighbour || neighbour->on != place.on) {
    refuse(plan_, item.name, "touching",
           "'" + item.touching + "' does not stand " + (place.on.empty() ? "on the floor" : "on '" + place.on + "'") +
               " at the start; name an object that stands on the same surface");
  }
  const Vector2d from = neighbour->middle, away = Vector2d(place.x, place.y) - from;
  if (away.norm() <= kFloorTolerance) {
    refuse(plan_, item.name, "x_m",
           "is the middle of '" + item.touching + "'; give a place on the side on which the object should touch it");
  }
  const geometry::Se3 turn{Eigen::Quaterniond(Eigen::AngleAxisd(place.yaw, Vector3d::UnitZ())), Vector3d::Zero()};
  const Vector2d slid = firstFreePosition(outlineAt(item.space.outline, turn), neighbour->footprint.outline_in_map,
                                          from, away.normalized());
  place.x = slid.x();
  place.y = slid.y();
  return place;
}

geometry::Se3 StandingSpace::poseOnFloor(const Stage& stage, const Item& item) const {
  const PlacePlan& place = *stage.place;
  const Vector2d middle(place.x, place.y);
  const auto number = roomAt(building_.rooms, middle);
  if (!number) {
    refuse(plan_, stage.section, stage.key,
           "the place " + base::brief(place.x) + " " + base::brief(place.y) + " lies in no room");
  }
  const Room& room = building_.rooms[*number];
  const geometry::Se3 pose{Eigen::Quaterniond(Eigen::AngleAxisd(place.yaw, Vector3d::UnitZ())),
                           {place.x, place.y, room.floorAt(middle)}};
  if (!isWithin(outlineAt(item.space.outline, pose), room.outline))
    refuse(plan_, stage.section, stage.key, "stands in a wall of '" + room.name + "'");
  return pose;
}

const Support& StandingSpace::supportOf(const Stage& stage, const Item& item) const {
  const std::string& name = stage.place->on;
  if (const Support* support = supports_.find(name)) return *support;
  const std::string near = base::nearestName(name, supports_.names());
  refuse(plan_, stage.section, stage.section == item.name && stage.key == "x_m" ? "on" : stage.key,
         "no level surface is called '" + name + "'" + (near.empty() ? "." : "; did you mean '" + near + "'?") +
             " Things stand on tables, counters and boards, and on objects of the classes " +
             base::option_text::format(carryingShapes()));
}

geometry::Se3 StandingSpace::poseOnSupport(const Stage& stage, const Item& item, const Support& support) const {
  const PlacePlan& place = *stage.place;
  const auto level = support.at(stage.begin);
  if (!level) {
    refuse(plan_, stage.section, stage.key,
           "'" + support.carrier + "' is away at " + base::brief(stage.begin) + " s, so nothing can be put on it");
  }
  const geometry::Se3 pose{Eigen::Quaterniond(Eigen::AngleAxisd(place.yaw, Vector3d::UnitZ())),
                           {place.x, place.y, level->z}};
  const Ring& base = support.is_of_object ? item.space.foot : item.space.outline;
  if (!isWithin(outlineAt(base, pose), level->outline_in_map)) {
    Ring surface;
    for (const Vector3d& p : support.outline_in_carrier) surface.push_back(p.head<2>());
    refuse(plan_, stage.section, stage.key,
           "reaches over the rim of '" + support.name + "': it fills " + sizeOf(base) + " on a surface of " +
               sizeOf(surface) + "; move it, make it smaller or put it elsewhere");
  }
  return pose;
}

std::vector<Track::Place> StandingSpace::placesIn(const Stage& stage, const Item& item) const {
  if (stage.place->on.empty()) return {{stage.begin, poseOnFloor(stage, item)}};
  const Support& support = supportOf(stage, item);
  const geometry::Se3 pose = poseOnSupport(stage, item, support);
  std::vector<Track::Place> places{{stage.begin, pose}};
  const geometry::Se3 carrier_from_item = inverse(*support.map_from_carrier.at(stage.begin)) * pose;
  for (const Track::Place& moved : support.map_from_carrier.places()) {
    if (moved.time <= stage.begin || moved.time >= stage.end) continue;
    places.push_back({moved.time, {}});
    if (moved.map_from_body) places.back().map_from_body = *moved.map_from_body * carrier_from_item;
  }
  return places;
}

void StandingSpace::takeStage(const Stage& stage, const Item& item, const std::vector<Track::Place>& places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].map_from_body) continue;
    const geometry::Se3& pose = *places[i].map_from_body;
    const double z = pose.translation.z();
    Taken taken{{item.name, outlineAt(item.space.outline, pose), z, z + item.space.height}};
    if (places[i].time > 0) taken.begin = places[i].time;
    taken.end = i + 1 < places.size() ? places[i + 1].time : stage.end;
    taken.on = stage.place->on;
    taken.middle = pose.translation.head<2>();
    take(stage, std::move(taken));
  }
}

Track StandingSpace::trackOf(const Item& item) {
  Item slid = item;
  if (!item.touching.empty()) slid.place = slidAgainst(item);
  std::vector<Track::Place> places;
  for (const Stage& stage : stagesOf(slid)) {
    if (!stage.place) {
      places.push_back({stage.begin, {}});
      continue;
    }
    const std::vector<Track::Place> stands = placesIn(stage, slid);
    takeStage(stage, slid, stands);
    places.insert(places.end(), stands.begin(), stands.end());
  }
  if (places.size() == 1) return Track(*places.front().map_from_body);
  return {Track::Kind::steps, std::move(places)};
}

}  // namespace omnimapper::sim
