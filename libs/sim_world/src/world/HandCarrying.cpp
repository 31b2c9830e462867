#include "HandCarrying.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace omnimapper::sim {

namespace {

ObjectPlan& objectOf(WorldPlan& plan, const CarryPlan& carrying) {
  std::vector<std::string> names;
  for (ObjectPlan& object : plan.objects) {
    if (object.name == carrying.object) return object;
    names.push_back(object.name);
  }
  const std::string near = base::nearestName(carrying.object, names);
  refuse(plan, carrying.person, "carrying",
         "no object is called '" + carrying.object + "'" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

Body& bodyNamed(World& world, const std::string& name) {
  return *std::find_if(world.bodies.begin(), world.bodies.end(), [&](const Body& body) { return body.name == name; });
}

double justBefore(double time) {
  return std::nextafter(time, -std::numeric_limits<double>::infinity());
}

using Carried = std::vector<MadePerson::Carried>;

// The track of something that stands until the first motion, between motions and after the last one.
Track trackThrough(const Carried& motions) {
  std::vector<Track::Place> places{{0, motions.front().places.front().map_from_body}};
  for (const MadePerson::Carried& motion : motions)
    places.insert(places.end(), motion.places.begin(), motion.places.end());
  return {Track::Kind::motion, std::move(places)};
}

// The motions of what stands at `map_from_rider` on a carried object.
Carried motionsOfRider(Carried motions, const geometry::Se3& map_from_rider) {
  const geometry::Se3 carrier_from_rider = inverse(*motions.front().places.front().map_from_body) * map_from_rider;
  for (MadePerson::Carried& motion : motions) {
    for (Track::Place& place : motion.places) place.map_from_body = *place.map_from_body * carrier_from_rider;
  }
  return motions;
}

}  // namespace

WorldPlan withMovesByHand(WorldPlan plan) {
  std::vector<CarryPlan> carryings = plan.carryings;
  std::stable_sort(carryings.begin(), carryings.end(),
                   [](const CarryPlan& a, const CarryPlan& b) { return a.begin < b.begin; });
  for (const CarryPlan& carrying : carryings) {
    std::vector<MovePlan>& moves = objectOf(plan, carrying).moves;
    const auto refuseThis = [&](const std::string& what) { refuse(plan, carrying.person, "carrying", what); };
    if (!moves.empty() && moves.back().person.empty())
      refuseThis("'" + carrying.object + "' has moves of its own; leave these out or carry another object");
    if (!moves.empty() && moves.back().time >= carrying.begin) {
      refuseThis("'" + carrying.object + "' is in the hands of '" + moves.back().person + "' until " +
                 base::brief(moves.back().time) + " s; take it later than at " + base::brief(carrying.begin) + " s");
    }
    moves.push_back({carrying.begin, {}, carrying.person});
    moves.push_back({carrying.end, carrying.to, carrying.person});
  }
  return plan;
}

std::vector<PersonSpec::Carrying> carryingsOf(const WorldPlan& plan, const std::string& person, const World& world) {
  std::vector<PersonSpec::Carrying> carryings;
  for (const CarryPlan& from : plan.carryings) {
    if (from.person != person) continue;
    const Body& body = *std::find_if(world.bodies.begin(), world.bodies.end(),
                                     [&](const Body& candidate) { return candidate.name == from.object; });
    const auto before = body.track.at(justBefore(from.begin)), after = body.track.at(from.end);
    if (!before) {
      refuse(plan, person, "carrying",
             "'" + from.object + "' is away at " + base::brief(from.begin) + " s; take it while it is there");
    }
    const ItemSpace space = spaceOf(body);
    carryings.push_back({from.begin, from.end, from.object, *before, *after, space.outline, space.height});
  }
  std::stable_sort(carryings.begin(), carryings.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  return carryings;
}

void moveByHand(const WorldPlan& plan, const StandingSpace& floor, Carried carried, World& world) {
  std::stable_sort(carried.begin(), carried.end(),
                   [](const auto& a, const auto& b) { return a.places.front().time < b.places.front().time; });
  std::map<std::string, Carried> motions;
  for (MadePerson::Carried& motion : carried) motions[motion.object].push_back(std::move(motion));
  for (const auto& [name, of_object] : motions) {
    const double begin = of_object.front().places.front().time;
    for (const std::string& rider : floor.ridersOf(name, begin)) {
      const auto own = std::find_if(plan.objects.begin(), plan.objects.end(),
                                    [&](const ObjectPlan& object) { return object.name == rider; });
      if (own == plan.objects.end() || !own->moves.empty()) {
        refuse(plan, rider, "moves",
               "stands on '" + name + "', which is carried by hand from " + base::brief(begin) +
                   " s on; leave the moves out or let it stand elsewhere");
      }
      Body& body = bodyNamed(world, rider);
      body.track = trackThrough(motionsOfRider(of_object, *body.track.at(justBefore(begin))));
    }
    bodyNamed(world, name).track = trackThrough(of_object);
  }
}

}  // namespace omnimapper::sim
