#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/People.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

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

}  // namespace

MadePerson makePerson(const PersonSpec& spec) {
  checkWaypoints(spec);
  checkSpan(spec);
  const Anatomy anatomy(spec.height);
  const Walk walk(spec.waypoints, anatomy.half_hips, kStepOfHeight * spec.height);
  checkActs(spec, walk, anatomy);
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
