#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/People.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "HandCarry.h"
#include "PersonBodies.h"
#include "Posture.h"

namespace omnimapper::sim {

namespace {

constexpr double kLeastHeight = 0.8, kMostHeight = 2.3;  // [m]
constexpr double kMostSpeed = 2.5;                       // [m/s]
constexpr double kLongest = 7200;       // longest time that a person walks and points, which is kept at 20 Hz [s]
constexpr double kNearestTarget = 0.6;  // from the head [m]
constexpr double kStepOfHeight = 0.4;

template <class... Parts>
[[noreturn]] void refuse(const PersonSpec& spec, const Parts&... parts) {
  std::ostringstream text;
  text << "person '" << spec.name << "': ";
  (text << ... << parts);
  throw base::Error(base::ExitCode::out_of_range, text.str());
}

void checkWaypoints(const PersonSpec& spec) {
  if (!(spec.height >= kLeastHeight && spec.height <= kMostHeight)) {
    refuse(spec, "height ", spec.height, " m is not in [", kLeastHeight, ", ", kMostHeight, "]");
  }
  if (spec.waypoints.empty()) refuse(spec, "it has no waypoint; give at least the place where it stands");
  for (std::size_t i = 0; i + 1 < spec.waypoints.size(); ++i) {
    const auto &from = spec.waypoints[i], &to = spec.waypoints[i + 1];
    if (!(from.time < to.time)) refuse(spec, "waypoint at ", to.time, " s comes after one at ", from.time, " s");
    const double speed = (to.in_map - from.in_map).norm() / (to.time - from.time);
    if (speed > kMostSpeed) {
      refuse(spec, "it would walk ", speed, " m/s from ", from.time, " to ", to.time, " s; at most ", kMostSpeed);
    }
  }
}

void checkSpan(const PersonSpec& spec) {
  double begin = spec.waypoints.front().time, end = spec.waypoints.back().time;
  for (const Person::Pointing& act : spec.acts) begin = std::min(begin, act.begin), end = std::max(end, act.end);
  for (const auto& carrying : spec.carryings)
    begin = std::min(begin, carrying.begin), end = std::max(end, carrying.end);
  if (!(end - begin <= kLongest))
    refuse(spec, "it walks and points from ", begin, " to ", end, " s; at most ", kLongest, " s are possible");
}

void checkActs(const PersonSpec& spec, const Walk& walk, const Anatomy& anatomy) {
  for (std::size_t i = 0; i < spec.acts.size(); ++i) {
    const Person::Pointing& act = spec.acts[i];
    if (!(act.begin < act.end)) refuse(spec, "an act of pointing ends at ", act.end, " s, begun at ", act.begin, " s");
    if (i > 0 && act.begin < spec.acts[i - 1].end + 2 * kArmRaiseTime) {
      refuse(spec, "the act of pointing at ", act.begin, " s begins before the arm of the one before is down; leave ",
             2 * kArmRaiseTime, " s");
    }
    if (!walk.stands(act.begin - kArmRaiseTime, act.end + kArmRaiseTime)) {
      refuse(spec, "it walks while it should point, from ", act.begin, " to ", act.end, " s; let it stand from ",
             kArmRaiseTime, " s before to ", kArmRaiseTime, " s after");
    }
    const Stance stance = walk.at(act.begin);
    const Eigen::Vector3d head(stance.body.x(), stance.body.y(),
                               spec.floor_z + anatomy.standing_hip_z + anatomy.head_up);
    if ((act.target_in_map - head).norm() < kNearestTarget) {
      refuse(spec, "the target at ", act.begin, " s is nearer than ", kNearestTarget, " m to the head");
    }
  }
}

void checkReach(const PersonSpec& spec, const PersonSpec::Carrying& carrying, double time, const geometry::Se3& object,
                const Walk& walk, const Anatomy& anatomy) {
  constexpr double kNearest = 0.2;  // of an object to the middle of the body [m]
  if (!walk.stands(time - kReachTime, time + kReachTime)) {
    refuse(spec, "it walks while it should take or put down '", carrying.object, "' at ", time,
           " s; let it stand from ", kReachTime, " s before to ", kReachTime, " s after");
  }
  const Eigen::Vector2d place = walk.at(time).body;
  const BodyFrame body{{place.x(), place.y(), spec.floor_z}, headingTo(object, place)};
  const double distance = (object.translation.head<2>() - place).norm();
  if (distance < kNearest || !stoopFor(handsOn(carrying, object, body, anatomy), body, anatomy)) {
    refuse(spec, "at ", time, " s the place of '", carrying.object, "' is ", distance, " m away, ",
           object.translation.z() - spec.floor_z, " m above the floor, which ",
           distance < kNearest ? "is too near" : "is out of reach", "; let the person stand about 0.4 m from it");
  }
}

void checkCarryings(const PersonSpec& spec, const Walk& walk, const Anatomy& anatomy) {
  for (std::size_t i = 0; i < spec.carryings.size(); ++i) {
    const PersonSpec::Carrying& carrying = spec.carryings[i];
    if (!(carrying.end - carrying.begin >= 2 * kLiftTime)) {
      refuse(spec, "it takes '", carrying.object, "' at ", carrying.begin, " s and puts it down at ", carrying.end,
             " s; at least ", 2 * kLiftTime, " s are needed");
    }
    if (i > 0 && carrying.begin < spec.carryings[i - 1].end + 2 * kReachTime) {
      refuse(spec, "it takes '", carrying.object, "' at ", carrying.begin, " s, but puts down '",
             spec.carryings[i - 1].object, "' at ", spec.carryings[i - 1].end, " s; leave ", 2 * kReachTime, " s");
    }
    for (const Person::Pointing& act : spec.acts) {
      if (act.begin - kArmRaiseTime < carrying.end + kReachTime &&
          carrying.begin - kReachTime < act.end + kArmRaiseTime)
        refuse(spec, "it points at ", act.begin, " s while its hands are busy with '", carrying.object, "'");
    }
    checkReach(spec, carrying, carrying.begin, carrying.map_from_object_before, walk, anatomy);
    checkReach(spec, carrying, carrying.end, carrying.map_from_object_after, walk, anatomy);
  }
}

MadePerson::Carried carriedAlong(const PersonSpec::Carrying& carrying, const std::vector<Posture>& postures) {
  constexpr double kApart = 1e-6;  // least time between two places [s]
  MadePerson::Carried carried{carrying.object, {{carrying.begin, carrying.map_from_object_before}}};
  for (const Posture& posture : postures) {
    if (posture.time > carrying.begin + kApart && posture.time < carrying.end - kApart)
      carried.places.push_back({posture.time, posture.map_from_held});
  }
  carried.places.push_back({carrying.end, carrying.map_from_object_after});
  return carried;
}

}  // namespace

MadePerson makePerson(const PersonSpec& spec) {
  checkWaypoints(spec);
  checkSpan(spec);
  const Anatomy anatomy(spec.height);
  const Walk walk(spec.waypoints, anatomy.half_hips, kStepOfHeight * spec.height);
  checkActs(spec, walk, anatomy);
  checkCarryings(spec, walk, anatomy);
  const std::vector<Posture> postures = posturesOf(spec, walk, anatomy);
  MadePerson made;
  made.bodies = bodiesOf(spec, anatomy, postures);
  made.person.name = spec.name;
  for (const Body& body : made.bodies) made.person.bodies.push_back(body.name);
  for (int i = 0; i < kJointCount; ++i) {
    const auto placeOf = [i](const Posture& posture) {
      return geometry::Se3{Eigen::Quaterniond::Identity(), posture.in_map.places[i]};
    };
    made.person.joints.push_back({kJointNames[i], trackAlong(postures, placeOf)});
  }
  made.person.pointing = spec.acts;
  for (const auto& carrying : spec.carryings) made.carried.push_back(carriedAlong(carrying, postures));
  return made;
}

std::vector<PersonSpec::Waypoint> walkAtSpeed(const std::vector<Eigen::Vector2d>& line, double speed, double begin) {
  if (!(speed > 0)) throw std::invalid_argument("a walk needs a speed above 0");
  std::vector<PersonSpec::Waypoint> waypoints;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i > 0) begin += (line[i] - line[i - 1]).norm() / speed;
    waypoints.push_back({line[i], begin});
  }
  return waypoints;
}

}  // namespace omnimapper::sim
