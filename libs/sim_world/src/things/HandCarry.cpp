#include "HandCarry.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace omnimapper::sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kMostLean = 1.2;         // [rad]
constexpr double kWideObject = 0.17;      // wider objects are held with both hands [m]
constexpr double kHandRadius = 0.025;     // of a hand that lies on a side, half sunk in by its fingers [m]
constexpr double kInFrontOfChest = 0.16;  // nearest that a carried object comes to the middle of the body [m]
constexpr double kArmReach = 0.995;       // part of the arm's length at which the elbow is still bent

// Distance from the origin to the border of a convex outline in a direction.
double borderAlong(const std::vector<Vector2d>& outline, const Vector2d& direction) {
  double farthest = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d &a = outline[i], edge = outline[(i + 1) % outline.size()] - a;
    const double denominator = direction.x() * edge.y() - direction.y() * edge.x();
    if (std::abs(denominator) < 1e-12) continue;
    const double range = (a.x() * edge.y() - a.y() * edge.x()) / denominator;
    const double along = (a.x() * direction.y() - a.y() * direction.x()) / denominator;
    if (along >= 0 && along <= 1) farthest = std::max(farthest, range);
  }
  return farthest;
}

// The same for an object that stands at a pose, in a direction of the map.
double borderAlong(const PersonSpec::Carrying& carrying, const geometry::Se3& map_from_object, const Vector3d& in_map) {
  const Vector3d in_object = map_from_object.rotation.conjugate() * in_map;
  return borderAlong(carrying.outline_in_object, in_object.head<2>().normalized());
}

Vector3d shoulderInBody(const Stoop& stoop, bool right, const Anatomy& anatomy) {
  const double side = right ? -anatomy.half_shoulders : anatomy.half_shoulders, up = anatomy.shoulder_up;
  return {up * std::sin(stoop.lean) - stoop.back, side,
          anatomy.standing_hip_z - stoop.drop + up * std::cos(stoop.lean)};
}

bool isInReach(const HandsOn& hands, double share, const BodyFrame& body, const Anatomy& anatomy) {
  const double reach = kArmReach * (anatomy.upper_arm + anatomy.forearm);
  const Stoop stoop(share, anatomy);
  for (const bool right : {false, true}) {
    if (!right && !hands.both) continue;
    const Vector3d shoulder = body.inMap(shoulderInBody(stoop, right, anatomy));
    if ((hands.in_map[right ? 1 : 0] - shoulder).norm() > reach) return false;
  }
  return true;
}

// Height of the middles of the hands above the foot of an object; above a thin one there is room for the fingers.
double gripHeight(const PersonSpec::Carrying& carrying) {
  return std::max(0.5 * carrying.height, 0.035);
}

// Where an object is carried: upright before the chest, or before the right half of it if one hand holds it.
geometry::Se3 carriedAt(const PersonSpec::Carrying& carrying, const BodyFrame& body, double yaw_in_hand,
                        const Anatomy& anatomy) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(body.yaw + yaw_in_hand, Vector3d::UnitZ()));
  const geometry::Se3 turned{turn, Vector3d::Zero()};
  const double behind = borderAlong(carrying, turned, body.direction(-Vector3d::UnitX()));
  const double ahead = std::max(anatomy.forearm, kInFrontOfChest + behind);
  const bool both = handsOn(carrying, turned, body, anatomy).both;
  const double elbow_z = anatomy.standing_hip_z + anatomy.shoulder_up - anatomy.upper_arm;
  return {turn, body.inMap({ahead, both ? 0 : -0.5 * anatomy.half_shoulders, elbow_z - gripHeight(carrying)})};
}

// Between where the object stands, at 0, and where it is carried, at 1: it is lifted before it is drawn near.
geometry::Se3 between(const geometry::Se3& standing, const geometry::Se3& carried, double share) {
  const double aside = eased(share), up = eased(1.6 * share);
  geometry::Se3 pose{standing.rotation.slerp(aside, carried.rotation),
                     standing.translation + aside * (carried.translation - standing.translation)};
  pose.translation.z() = standing.translation.z() + up * (carried.translation.z() - standing.translation.z());
  return pose;
}

}  // namespace

Vector3d BodyFrame::inMap(const Vector3d& in_body) const {
  return on_floor + direction(in_body);
}

Vector3d BodyFrame::direction(const Vector3d& in_body) const {
  return Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) * in_body;
}

Stoop::Stoop(double share, const Anatomy& anatomy)
    : lean(kMostLean * share),
      back(0.1 * anatomy.height * std::sin(lean)),
      drop(0.3 * anatomy.height * share * share) {}

HandsOn handsOn(const PersonSpec::Carrying& carrying, const geometry::Se3& map_from_object, const BodyFrame& body,
                const Anatomy& anatomy) {
  const Vector3d left = body.direction(Vector3d::UnitY());
  const double to_left = borderAlong(carrying, map_from_object, left),
               to_right = borderAlong(carrying, map_from_object, -left);
  const double hand = kHandRadius * anatomy.height / 1.72;
  const Vector3d middle = map_from_object * Vector3d(0, 0, gripHeight(carrying));
  return {to_left + to_right > kWideObject, {middle + (to_left + hand) * left, middle - (to_right + hand) * left}};
}

std::optional<double> stoopFor(const HandsOn& hands, const BodyFrame& body, const Anatomy& anatomy) {
  constexpr int kSteps = 20, kHalvings = 20;
  if (isInReach(hands, 0, body, anatomy)) return 0;
  for (int i = 1; i <= kSteps; ++i) {
    double high = static_cast<double>(i) / kSteps, low = high - 1.0 / kSteps;
    if (!isInReach(hands, high, body, anatomy)) continue;
    for (int halving = 0; halving < kHalvings; ++halving) {
      const double middle = (low + high) / 2;
      (isInReach(hands, middle, body, anatomy) ? high : low) = middle;
    }
    return high;
  }
  return {};
}

double headingTo(const geometry::Se3& map_from_object, const Vector2d& place) {
  const Vector2d ahead = map_from_object.translation.head<2>() - place;
  return std::atan2(ahead.y(), ahead.x());
}

std::optional<Hold> holdAt(const PersonSpec::Carrying& carrying, double time, const BodyFrame& body, double yaw_in_hand,
                           const Anatomy& anatomy) {
  if (time < carrying.begin - kReachTime || time > carrying.end + kReachTime) return {};
  if (time < carrying.begin)
    return Hold{carrying.map_from_object_before, eased(1 - (carrying.begin - time) / kReachTime), 0};
  if (time > carrying.end)
    return Hold{carrying.map_from_object_after, eased(1 - (time - carrying.end) / kReachTime), 0};
  const geometry::Se3 carried = carriedAt(carrying, body, yaw_in_hand, anatomy);
  const double since = (time - carrying.begin) / kLiftTime, until = (carrying.end - time) / kLiftTime;
  const bool is_taken = since < until;
  const double share = std::clamp(is_taken ? since : until, 0.0, 1.0);
  const geometry::Se3& standing = is_taken ? carrying.map_from_object_before : carrying.map_from_object_after;
  return Hold{between(standing, carried, share), 1, eased(share)};
}

double eased(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

}  // namespace omnimapper::sim
