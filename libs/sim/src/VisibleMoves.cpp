#include "VisibleMoves.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/sim/Drive.h>
#include <omnimapper/sim_world/Building.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace omnimapper::sim {

namespace {

/// The objects that are carried at one time, and the rooms that they are taken from and put in.
struct Carrying {
  std::set<std::string> objects;
  std::set<int> rooms;
};

std::map<double, Carrying> carryingsOf(const World& world, double duration) {
  std::set<std::string> names;
  for (const Object& object : world.objects) names.insert(object.name);
  for (const Marker& marker : world.markers) names.insert(marker.name);
  std::map<double, Carrying> carryings;
  for (const Body& body : world.bodies) {
    if (names.count(body.name) == 0 || body.track.kind() == Track::Kind::motion) continue;
    const auto& places = body.track.places();
    for (std::size_t i = 1; i < places.size() && places[i].time < duration; ++i) {
      Carrying& carrying = carryings[places[i].time];
      carrying.objects.insert(body.name);
      for (const auto& place : {places[i - 1], places[i]}) {
        if (!place.map_from_body) continue;
        if (const auto room = roomAt(world.rooms, place.map_from_body->translation.head<2>()))
          carrying.rooms.insert(*room);
      }
    }
  }
  return carryings;
}

double distanceTo(const Visit& visit, double time) {
  return std::max({visit.enter - time, time - visit.leave, 0.0});
}

}  // namespace

std::vector<std::string> visibleMoves(const World& world, const Track& map_from_base, double duration) {
  std::vector<std::string> sentences;
  const auto carryings = carryingsOf(world, duration);
  if (carryings.empty()) return sentences;
  const std::vector<Visit> visits = visitsOf(world, map_from_base);
  for (const auto& [time, carrying] : carryings) {
    const Visit *now = nullptr, *unseen = nullptr;
    for (const Visit& visit : visits) {
      if (visit.enter <= time) now = &visit;
      if (carrying.rooms.count(visit.room) > 0 || visit.enter > duration) continue;
      if (!unseen || distanceTo(visit, time) < distanceTo(*unseen, time)) unseen = &visit;
    }
    if (!now || carrying.rooms.count(now->room) == 0) continue;
    std::string objects;
    for (const std::string& object : carrying.objects) objects += (objects.empty() ? "" : ", ") + object;
    std::string sentence = "at " + base::fixed(time, 1) + " s objects are carried from or to '" +
                           world.rooms[now->room].name + "', where the robot is then and sees them jump: " + objects;
    if (unseen) {
      sentence += "; from " + base::fixed(unseen->enter, 1) + " to " + base::fixed(unseen->leave, 1) + " s it is in '" +
                  world.rooms[unseen->room].name + "', where none of them is";
    }
    sentences.push_back(sentence);
  }
  return sentences;
}

}  // namespace omnimapper::sim
