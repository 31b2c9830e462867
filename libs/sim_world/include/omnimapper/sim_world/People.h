#pragma once

#include <omnimapper/sim_world/World.h>

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// Time in which an arm is raised before an act of pointing, and lowered after it [s].
constexpr double kArmRaiseTime = 0.6;

struct PersonSpec {
  /// The place of the person at a time. Between two waypoints at different places it walks at constant speed; between
  /// two at the same place it stands.
  struct Waypoint {
    Eigen::Vector2d in_map;  ///< [m]
    double time = 0;         ///< [s]
  };
  std::string name;                    ///< bodies and their surfaces are called "<name>/head", ...
  double height = 1.72;                ///< [m]
  double floor_z = 0;                  ///< [m]
  double yaw = 0;                      ///< where it looks until it first walks or points [rad]
  std::uint64_t seed = 0;              ///< determines clothes, skin and hair
  std::vector<Waypoint> waypoints;     ///< in order of time, at least one
  std::vector<Person::Pointing> acts;  ///< in order of time; the person must stand then
};

struct MadePerson {
  Person person;
  /// head, torso, and left_ and right_ thigh, shin, foot, upper_arm and forearm (with the hand): closed solids, each
  /// with its track at 20 Hz, exact at multiples of 0.05 s; while a part rests, only its first and last place are kept.
  std::vector<Body> bodies;
};

/// A person who walks, stands and points.
///
/// Lengths of limbs are parts of the height after Drillis and Contini (1966; in Winter: Biomechanics and Motor Control
/// of Human Movement). The legs are IK chains from footprints: a planted foot stays where it is while the body passes
/// over it, steps are about 0.7 m (0.4 of the height), and at the height of a laser the shins are two circles of 12 cm
/// that overtake one another.
///
/// Pointing: the head turns to the target and the hand lies on the line from the head (its middle, which for a head
/// that looks at the target is on the line of sight) to the target, as with people who aim with the fingertip, so that
/// the head-hand ray is exact. Shoulder, elbow and hand are stretched to 99.5 % of the arm, the elbow hanging down and
/// out. As the shoulder is below and beside the eyes, the elbow-hand ray passes above the target, by 5 to 28 degrees,
/// and, of a right arm, to the left of it, by up to 22 (targets 1.5 to 2.5 m away at 0.2 to 1.5 m above the floor). The
/// sensor SkeletonTracker adds the errors of people and of skeleton trackers. A person turns before pointing if the
/// target is out of the arm's reach.
///
/// Throws base::Error(out_of_range) for a height out of [0.8, 2.3] m, times that do not increase, more than 2.5 m/s, an
/// act while it walks or that overlaps another, more than 7200 s from first to last, and a target nearer than 0.6 m to
/// the head.
MadePerson makePerson(const PersonSpec& spec);

/// Waypoints along a line at constant speed [m/s] from time `begin` on [s]. Throws std::invalid_argument unless speed >
/// 0.
std::vector<PersonSpec::Waypoint> walkAtSpeed(const std::vector<Eigen::Vector2d>& line, double speed, double begin);

}  // namespace omnimapper::sim
