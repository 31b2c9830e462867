#pragma once

#include <omnimapper/sim_world/World.h>

#include <cstdint>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// Time in which an arm is raised before an act of pointing, and lowered after it [s].
constexpr double kArmRaiseTime = 0.6;

struct PersonSpec {
  /// The place of the person at a time. Between two waypoints at different places the person walks at constant speed;
  /// between two waypoints at the same place the person stands.
  struct Waypoint {
    Eigen::Vector2d in_map;  ///< [m]
    double time = 0;         ///< [s]
  };
  /// An object that the person takes where it stands, carries and puts down.
  struct Carrying {
    double begin = 0, end = 0;  ///< time at which the hands take it, and time at which they let it go [s]
    std::string object;
    geometry::Se3 map_from_object_before, map_from_object_after;  ///< where it stands upright before and after
    std::vector<Eigen::Vector2d> outline_in_object;  ///< convex, seen from above, with the origin inside [m]
    double height = 0;                               ///< of the object [m]
  };
  std::string name;                    ///< bodies and their surfaces are called "<name>/head", ...
  double height = 1.72;                ///< [m]
  double floor_z = 0;                  ///< [m]
  double yaw = 0;                      ///< where it looks until it first walks or points [rad]
  std::uint64_t seed = 0;              ///< determines clothes, skin and hair
  std::vector<Waypoint> waypoints;     ///< in order of time, at least one
  std::vector<Person::Pointing> acts;  ///< in order of time; the person must stand then
  /// In order of time; the person must stand while it takes an object or puts it down, and neither points nor carries
  /// anything else meanwhile.
  std::vector<Carrying> carryings = {};
};

struct MadePerson {
  Person person;
  /// head, torso, and left_ and right_ thigh, shin, foot, upper_arm and forearm (with the hand): closed solids, each
  /// with its track at 20 Hz, exact at multiples of 0.05 s; of equal places in a row, only the first and the last are
  /// kept.
  std::vector<Body> bodies;
  /// The poses of a carried object, from where it stood at the begin of the carrying to where it stands at its end.
  struct Carried {
    std::string object;
    std::vector<Track::Place> places;
  };
  std::vector<Carried> carried = {};
};

/// A person who walks, stands, points and carries objects.
///
/// Lengths of limbs are parts of the height after Drillis and Contini (1966; in Winter: Biomechanics and Motor Control
/// of Human Movement). The legs are chains whose joint angles follow from the footprints (inverse kinematics): a
/// planted foot stays where it is while the body passes over it, steps are about 0.7 m (0.4 of the height), and at the
/// height of a laser the shins are two circles of 12 cm that overtake one another.
///
/// Pointing: the head turns to the target, and the hand lies on the line from the middle of the head to the target, as
/// with people who aim with the fingertip. The head-hand ray is therefore exact; for a head that looks at the target,
/// the line of sight is the same line. Shoulder, elbow and hand are stretched to 99.5 % of the length of the arm, and
/// the elbow hangs down and out. The shoulder is below and beside the eyes. The elbow-hand ray therefore passes above
/// the target, by 5 to 28 degrees; with a right arm it also passes to the left of the target, by up to 22 degrees.
/// (This holds for targets 1.5 to 2.5 m away, 0.2 to 1.5 m above the floor.) The sensor SkeletonTracker adds the errors
/// of people and of skeleton trackers. A person turns before pointing if the target is out of the arm's reach.
///
/// Carrying: the person turns to the object, bends down as far as the arms need, grips it on its right side or, if it
/// is wider than 0.17 m, on both sides, and lifts it within 1 s to where it is carried upright, before the chest with
/// bent elbows.
///
/// Throws base::Error(out_of_range) for a height outside [0.8, 2.3] m, times that do not increase, a speed above 2.5
/// m/s, an act of pointing while the person walks or that overlaps another act, more than 7200 s from the first time to
/// the last, a target nearer than 0.6 m to the head, and an object that is out of reach or is taken or
/// put down while the person walks.
MadePerson makePerson(const PersonSpec& spec);

/// Waypoints along a line at constant speed [m/s] from time `begin` on [s]. Throws std::invalid_argument unless speed >
/// 0.
std::vector<PersonSpec::Waypoint> walkAtSpeed(const std::vector<Eigen::Vector2d>& line, double speed, double begin);

}  // namespace omnimapper::sim
