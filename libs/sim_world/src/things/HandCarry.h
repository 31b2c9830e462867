#pragma once

#include <omnimapper/sim_world/People.h>
#include <omnimapper/sim_world/Skeleton.h>

#include <array>
#include <optional>

namespace omnimapper::sim {

constexpr double kReachTime = 1.0;  // in which hands go to an object, and back after it is put down [s]
constexpr double kLiftTime = 1.0;   // in which an object goes from where it stands to where it is carried, and back [s]

/// Where a person is. Frame of the body: x ahead, y to the left, z up, origin on the floor.
struct BodyFrame {
  Eigen::Vector3d on_floor;  // in the map [m]
  double yaw = 0;            // [rad]
  Eigen::Vector3d inMap(const Eigen::Vector3d& in_body) const;
  Eigen::Vector3d direction(const Eigen::Vector3d& in_body) const;
};

/// How a person bends down: the trunk leans forward about the hips, which go back and down while the knees bend.
struct Stoop {
  /// From 0, upright, to 1.
  Stoop(double share, const Anatomy& anatomy);
  double lean;        // of the trunk [rad]
  double back, drop;  // of the hips [m]
};

/// The hands on the sides of an object: one to the right of a narrow object, two beside a wide one.
struct HandsOn {
  bool both = false;
  std::array<Eigen::Vector3d, 2> in_map;  // middles of the left and of the right hand; the left counts only if both
};
HandsOn handsOn(const PersonSpec::Carrying& carrying, const geometry::Se3& map_from_object, const BodyFrame& body,
                const Anatomy& anatomy);

/// The smallest share of stooping at which the hands of a standing person are in reach; none if they never are.
std::optional<double> stoopFor(const HandsOn& hands, const BodyFrame& body, const Anatomy& anatomy);

/// The heading of a person at `place` who takes or puts down an object.
double headingTo(const geometry::Se3& map_from_object, const Eigen::Vector2d& place);

/// An object that is being taken, carried or put down.
struct Hold {
  geometry::Se3 map_from_object;
  double share = 0;   // of the way of the hands to the object: 0 they hang, 1 they are on it
  double lifted = 0;  // 0 where it stands, 1 where it is carried
};
/// None if the hands are not busy with the object at that time. `yaw_in_hand` is the yaw of the carried object in the
/// frame of the body.
std::optional<Hold> holdAt(const PersonSpec::Carrying& carrying, double time, const BodyFrame& body, double yaw_in_hand,
                           const Anatomy& anatomy);

/// A smooth step: 0 up to share 0, 1 from share 1 on.
double eased(double share);

}  // namespace omnimapper::sim
