#include <omnimapper/base/Config.h>
#include <omnimapper/sim/Companions.h>
#include <omnimapper/sim_world/Building.h>
#include <omnimapper/sim_world/People.h>

#include <algorithm>
#include <cmath>

#include "CompanionSearch.h"
#include "CompanionWish.h"

namespace omnimapper::sim {

using Eigen::Vector2d;

namespace {

constexpr double kPersonRadius = 0.22;    // [m]
constexpr double kRobotDistance = 0.52;   // least distance at the times of the search; between them it may be less [m]
constexpr double kBesideRobot = 0.27;     // least distance from the rim of the robot [m]
constexpr double kSettle = 4;             // time after the end of the drive in which a companion may still walk [s]
constexpr double kLongestCompany = 7190;  // [s]

/// Limits of a search for a walk. If it fails, wider ones follow; in a crowd one may have to squeeze past others.
struct Attempt {
  double window, others_distance;  // largest distance from the wished place, least between two people [m]
};
constexpr Attempt kAttempts[] = {{2, 0.38}, {4, 0.38}, {4, 0.25}, {4, 0}};

std::vector<Vector2d> doorsOf(const World& world) {
  std::vector<Vector2d> middles;
  for (const surfaces::Opening& opening : world.openings) {
    const bool is_closed = opening.leaf == surfaces::Opening::Leaf::closed;
    if (opening.kind == surfaces::Opening::Kind::window || is_closed) continue;
    middles.push_back((opening.rectangle[0] + opening.rectangle[1]).head<2>() / 2);
  }
  return middles;
}

Polyline placesOf(const Person& person, std::size_t count) {
  Polyline places;
  const Track& torso = jointOf(person, "torso").in_map;
  for (std::size_t i = 0; i < count; ++i)
    places.push_back(torso.at(static_cast<double>(i) * kCompanionStep)->translation.head<2>());
  return places;
}

// Who has moved by less than a millimetre stands.
std::vector<PersonSpec::Waypoint> waypointsOf(Polyline places) {
  constexpr double kStanding = 1e-3;  // [m]
  for (std::size_t i = 1; i < places.size(); ++i) {
    if ((places[i] - places[i - 1]).norm() < kStanding) places[i] = places[i - 1];
  }
  std::vector<PersonSpec::Waypoint> waypoints;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool rests = i > 0 && i + 1 < places.size() && places[i - 1] == places[i] && places[i] == places[i + 1];
    if (!rests) waypoints.push_back({places[i], static_cast<double>(i) * kCompanionStep});
  }
  return waypoints;
}

class Company {
 public:
  Company(World& world, const WorldPlan& plan, const Track& map_from_base, double robot_radius)
      : world_(world),
        plan_(plan),
        path_(map_from_base),
        space_(world, std::min(kPersonRadius, robot_radius)),
        doors_(doorsOf(world)),
        robot_distance_(std::max(kRobotDistance, robot_radius + kBesideRobot)),
        count_(static_cast<std::size_t>(std::ceil((path_.end() + kSettle) / kCompanionStep)) + 1) {
    for (std::size_t i = 0; i < count_; ++i) robot_.push_back(path_.robotAt(static_cast<double>(i) * kCompanionStep));
  }

  void add(const CompanionPlan& companion) {
    if (path_.end() > kLongestCompany) {
      refuse(plan_, companion.name, "class",
             "the drive takes " + base::option_text::format(path_.end()) + " s; people accompany a robot for at most " +
                 base::option_text::format(kLongestCompany) + " s: set [robot] duration_s");
    }
    PersonSpec spec;
    spec.name = companion.name;
    spec.height = companion.height;
    spec.seed = companion.seed;
    spec.waypoints = waypointsOf(walkOf(companion));
    const Vector2d first = spec.waypoints.front().in_map;
    if (const auto room = roomAt(world_.rooms, first)) spec.floor_z = world_.rooms[*room].floorAt(first);
    const Vector2d to_robot = robot_.front() - first;
    spec.yaw = std::atan2(to_robot.y(), to_robot.x());
    MadePerson made = makePerson(spec);
    for (Body& body : made.bodies) world_.bodies.push_back(std::move(body));
    made.person.accompanies = true;
    world_.people.push_back(std::move(made.person));
  }

 private:
  Polyline walkOf(const CompanionPlan& companion) const {
    CompanionObstacles obstacles{space_, robot_, robot_distance_, {}, 0};
    for (const Person& person : world_.people) obstacles.others.push_back(placesOf(person, count_));
    const Polyline wished = wishedPlaces(companion, path_, space_, doors_, count_);
    for (const Attempt& attempt : kAttempts) {
      obstacles.others_distance = attempt.others_distance;
      Polyline walk = walkNear(wished, obstacles, attempt.window);
      if (!walk.empty()) return walk;
    }
    refuse(plan_, companion.name, "place", "there is no room for a person near the robot");
  }

  World& world_;
  const WorldPlan& plan_;
  RobotPath path_;
  RobotSpace space_;
  std::vector<Vector2d> doors_;
  double robot_distance_;
  std::size_t count_;
  Polyline robot_;
};

}  // namespace

void addCompanions(World& world, const WorldPlan& plan, const Track& map_from_base, double robot_radius) {
  if (plan.companions.empty()) return;
  Company company(world, plan, map_from_base, robot_radius);
  for (const CompanionPlan& companion : plan.companions) company.add(companion);
  validate(world);
}

}  // namespace omnimapper::sim
