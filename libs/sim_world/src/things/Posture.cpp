#include "Posture.h"

#include <omnimapper/geometry/Angle.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "HandCarry.h"

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPeriod = 0.05;     // [s]
constexpr double kTurnRate = 3;      // largest turn rate of the body [rad/s]
constexpr double kTurnTime = 1.3;    // time before an act or a walk at which the body begins to turn [s]
constexpr double kFacingTime = 0.3;  // time after an object is taken or put down for which the body still faces it [s]
constexpr double kLookAhead = 0.25;  // time by which a walking body turns before its path does [s]
constexpr double kArmStretch = 0.995;
// Largest angles between a pointing arm and the body's heading: outwards and across the body [rad].
constexpr double kOutwards = 1.9, kAcross = 0.6;

// The joint between two limbs of given lengths from `root` to `end`, bent towards `pole`.
Vector3d jointBetween(const Vector3d& root, const Vector3d& end, double upper, double lower, const Vector3d& pole) {
  const double distance = std::clamp((end - root).norm(), std::abs(upper - lower) + 1e-9, upper + lower);
  const Vector3d ahead = (end - root).normalized();
  const double along = (distance * distance + upper * upper - lower * lower) / (2 * distance);
  const Vector3d aside = (pole - pole.dot(ahead) * ahead).normalized();
  return root + along * ahead + std::sqrt(std::max(0.0, upper * upper - along * along)) * aside;
}

// Share by which the arm is raised: 0 while it hangs, 1 from begin to end of the act.
double raised(const Person::Pointing& act, double time) {
  return time < act.begin ? eased(1 - (act.begin - time) / kArmRaiseTime) : eased(1 - (time - act.end) / kArmRaiseTime);
}

// The heading nearest to `yaw` from which the arm reaches the target's direction.
double headingFor(const Person::Pointing& act, const Vector2d& body, double yaw) {
  const Vector2d to_target = act.target_in_map.head<2>() - body;
  if (to_target.norm() < 0.05) return yaw;
  const double aside = geometry::wrapToPi(std::atan2(to_target.y(), to_target.x()) - yaw);
  const double low = act.right_arm ? -kOutwards : -kAcross, high = act.right_arm ? kAcross : kOutwards;
  return yaw + aside - std::clamp(aside, low, high);
}

class Poser {
 public:
  Poser(const PersonSpec& spec, const Walk& walk, const Anatomy& anatomy)
      : spec_(spec), walk_(walk), anatomy_(anatomy), yaw_(spec.yaw) {}

  // To be called for times in order: the body turns from where it was.
  Posture next(double time) {
    const Stance stance = walk_.at(time);
    turn(time, stance);
    Posture posture;
    posture.time = time;
    posture.yaw = yaw_;
    const std::optional<Busy> busy = busyAt(time, stance);
    if (busy) posture.map_from_held = busy->hold.map_from_object;
    const Stoop stoop(busy ? busy->stoop : 0, anatomy_);
    posture.lean = stoop.lean;
    placeFeet(stance, posture);
    const double hip_z = placeHips(stance, stoop, posture);
    placeTrunk(stance, stoop, hip_z, posture);
    posture.head_yaw = yaw_;
    for (const bool right : {false, true}) {
      Vector3d hand = pointing(time, right, direction(hangingHand(stance, right, posture)), posture);
      if (busy) hand = holding(*busy, right, hand, posture);
      placeArm(hand, right, posture);
    }
    if (busy) look(posture.map_from_held->translation, busy->hold.share * (1 - busy->hold.lifted), posture);
    return posture;
  }

 private:
  Vector3d inMap(const Stance& stance, const Vector3d& in_body) const {
    const Vector3d turned = Eigen::AngleAxisd(yaw_, Vector3d::UnitZ()) * in_body;
    return Vector3d(stance.body.x(), stance.body.y(), spec_.floor_z) + turned;
  }
  Vector3d direction(const Vector3d& in_body) const { return Eigen::AngleAxisd(yaw_, Vector3d::UnitZ()) * in_body; }
  BodyFrame frame(const Stance& stance) const { return {{stance.body.x(), stance.body.y(), spec_.floor_z}, yaw_}; }

  /// Hands that take, carry or put down an object.
  struct Busy {
    Hold hold;
    HandsOn hands;
    double stoop;  // share
  };
  // To be called for times in order: an object keeps the yaw that it has when it is taken.
  std::optional<Busy> busyAt(double time, const Stance& stance) {
    for (const PersonSpec::Carrying& carrying : spec_.carryings) {
      if (time < carrying.begin) yaw_in_hand_ = yawOf(carrying.map_from_object_before) - yaw_;
      const BodyFrame body = frame(stance);
      const auto hold = holdAt(carrying, time, body, yaw_in_hand_, anatomy_);
      if (time < carrying.begin && !hold) break;
      if (!hold) continue;
      const HandsOn hands = handsOn(carrying, hold->map_from_object, body, anatomy_);
      return Busy{*hold, hands, hold->share * stoopFor(hands, body, anatomy_).value_or(1)};
    }
    return {};
  }

  static double yawOf(const geometry::Se3& pose) {
    const Vector3d ahead = pose.rotation * Vector3d::UnitX();
    return std::atan2(ahead.y(), ahead.x());
  }

  void turn(double time, const Stance& stance) {
    double wanted = yaw_;
    if (stance.walks) {
      const Stance soon = walk_.at(time + kLookAhead);
      wanted = soon.walks ? soon.heading : stance.heading;
    } else if (const double* heading = walk_.headingSoon(time, kTurnTime)) {
      wanted = *heading;
    }
    for (const Person::Pointing& act : spec_.acts) {
      const bool soon = time >= act.begin - kArmRaiseTime - kTurnTime && time <= act.end;
      if (soon && !stance.walks) wanted = headingFor(act, stance.body, yaw_);
    }
    for (const PersonSpec::Carrying& carrying : spec_.carryings) {
      if (stance.walks) break;
      const bool takes = time >= carrying.begin - kReachTime - kTurnTime && time <= carrying.begin + kFacingTime;
      const bool puts = time >= carrying.end - kLiftTime && time <= carrying.end + kFacingTime;
      if (takes) wanted = headingTo(carrying.map_from_object_before, stance.body);
      if (puts) wanted = headingTo(carrying.map_from_object_after, stance.body);
    }
    yaw_ += std::clamp(geometry::wrapToPi(wanted - yaw_), -kTurnRate * kPeriod, kTurnRate * kPeriod);
  }

  void placeFeet(const Stance& stance, Posture& posture) const {
    for (const bool right : {false, true}) {
      const Stance::Foot& foot = right ? stance.right : stance.left;
      Vector3d& place = posture.in_map[jointOf(right, Limb::foot)];
      double& foot_yaw = right ? posture.right_foot_yaw : posture.left_foot_yaw;
      if (stance.walks) {
        place = {foot.in_map.x(), foot.in_map.y(), spec_.floor_z + anatomy_.ankle_z + foot.lift};
        foot_yaw = foot.yaw;
      } else {
        place = inMap(stance, {0, right ? -anatomy_.half_hips : anatomy_.half_hips, anatomy_.ankle_z});
        foot_yaw = yaw_;
      }
    }
  }

  // Places the hips as high as both legs allow. Returns their height above the floor.
  double placeHips(const Stance& stance, const Stoop& stoop, Posture& posture) const {
    const double reach = 0.995 * (anatomy_.thigh + anatomy_.shin);
    double hip_z = anatomy_.standing_hip_z - stoop.drop;
    for (const bool right : {false, true}) {
      const Vector3d foot = posture.in_map[jointOf(right, Limb::foot)];
      const Vector3d hip = inMap(stance, {-stoop.back, right ? -anatomy_.half_hips : anatomy_.half_hips, 0});
      const double aside = std::min((foot - hip).head<2>().norm(), 0.9 * reach);
      hip_z = std::min(hip_z, foot.z() - spec_.floor_z + std::sqrt(reach * reach - aside * aside));
    }
    for (const bool right : {false, true}) {
      const Vector3d hip = inMap(stance, {-stoop.back, right ? -anatomy_.half_hips : anatomy_.half_hips, hip_z});
      const Vector3d& foot = posture.in_map[jointOf(right, Limb::foot)];
      posture.in_map[jointOf(right, Limb::hip)] = hip;
      posture.in_map[jointOf(right, Limb::knee)] =
          jointBetween(hip, foot, anatomy_.thigh, anatomy_.shin, direction(Vector3d::UnitX()));
    }
    return hip_z;
  }

  void placeTrunk(const Stance& stance, const Stoop& stoop, double hip_z, Posture& posture) const {
    const auto above = [&](double up, double side) {
      return inMap(stance, {up * std::sin(stoop.lean) - stoop.back, side, hip_z + up * std::cos(stoop.lean)});
    };
    posture.in_map[Joint::torso] = above(anatomy_.torso_up, 0);
    posture.in_map[Joint::neck] = above(anatomy_.neck_up, 0);
    posture.in_map[Joint::head] = above(anatomy_.head_up, 0);
    for (const bool right : {false, true}) {
      const double side = right ? -anatomy_.half_shoulders : anatomy_.half_shoulders;
      posture.in_map[jointOf(right, Limb::shoulder)] = above(anatomy_.shoulder_up, side);
    }
  }

  // Where the hand of a hanging arm is, from the shoulder; arms swing against the legs.
  Vector3d hangingHand(const Stance& stance, bool right, const Posture& posture) const {
    double swing = 0;
    if (stance.walks) {
      const Vector3d apart = posture.in_map[Joint::left_foot] - posture.in_map[Joint::right_foot];
      swing = (right ? 0.8 : -0.8) * apart.dot(direction(Vector3d::UnitX())) / anatomy_.height;
    }
    const Vector3d down(std::sin(0.12 + swing), right ? -0.1 : 0.1, -std::cos(0.12 + swing));
    return 0.97 * (anatomy_.upper_arm + anatomy_.forearm) * down.normalized();
  }

  // The hand of an arm that points, from the shoulder: on the line from the head to the target, at arm's length.
  Vector3d pointingHand(const Person::Pointing& act, const Vector3d& shoulder, const Vector3d& head) const {
    const double reach = kArmStretch * (anatomy_.upper_arm + anatomy_.forearm);
    const Vector3d ahead = (act.target_in_map - head).normalized(), from_shoulder = head - shoulder;
    const double along = from_shoulder.dot(ahead);
    const double distance =
        -along + std::sqrt(std::max(0.0, along * along - from_shoulder.squaredNorm() + reach * reach));
    return from_shoulder + distance * ahead;
  }

  // A hand, from the shoulder, that has gone a share of its way, on an arc around the shoulder.
  static Vector3d onTheWay(const Vector3d& from, const Vector3d& to, double share) {
    const Eigen::Quaterniond arc = Eigen::Quaterniond::FromTwoVectors(from, to);
    const double length = from.norm() + share * (to.norm() - from.norm());
    return length * (Eigen::Quaterniond::Identity().slerp(share, arc) * from.normalized());
  }

  static void look(const Vector3d& target_in_map, double share, Posture& posture) {
    const Vector3d gaze = target_in_map - posture.in_map[Joint::head];
    posture.head_yaw += share * geometry::wrapToPi(std::atan2(gaze.y(), gaze.x()) - posture.head_yaw);
    posture.head_pitch += share * std::atan2(gaze.z(), gaze.head<2>().norm());
  }

  // Where acts of pointing move a hand, from the shoulder.
  Vector3d pointing(double time, bool right, Vector3d hand, Posture& posture) const {
    const Vector3d& shoulder = posture.in_map[jointOf(right, Limb::shoulder)];
    for (const Person::Pointing& act : spec_.acts) {
      const double share = raised(act, time);
      if (act.right_arm != right || share <= 0) continue;
      hand = onTheWay(hand, pointingHand(act, shoulder, posture.in_map[Joint::head]), share);
      look(act.target_in_map, share, posture);
    }
    return hand;
  }

  // Where an object that the hands are busy with moves a hand, from the shoulder.
  Vector3d holding(const Busy& busy, bool right, const Vector3d& hand, const Posture& posture) const {
    if (!right && !busy.hands.both) return hand;
    const Vector3d& shoulder = posture.in_map[jointOf(right, Limb::shoulder)];
    const Vector3d there = onTheWay(hand, busy.hands.in_map[right ? 1 : 0] - shoulder, busy.hold.share);
    const double reach = kArmStretch * (anatomy_.upper_arm + anatomy_.forearm);
    return std::min(1.0, reach / there.norm()) *
           there;  // an arm on its way may still be stretched while the body bends
  }

  void placeArm(const Vector3d& hand, bool right, Posture& posture) const {
    const Vector3d& shoulder = posture.in_map[jointOf(right, Limb::shoulder)];
    const Vector3d pole = direction({-0.5, right ? -0.3 : 0.3, -1});
    posture.in_map[jointOf(right, Limb::hand)] = shoulder + hand;
    posture.in_map[jointOf(right, Limb::elbow)] =
        jointBetween(shoulder, shoulder + hand, anatomy_.upper_arm, anatomy_.forearm, pole);
  }

  const PersonSpec& spec_;
  const Walk& walk_;
  const Anatomy& anatomy_;
  double yaw_;
  double yaw_in_hand_ = 0;  // yaw of a carried object in the frame of the body [rad]
};

}  // namespace

std::vector<Posture> posturesOf(const PersonSpec& spec, const Walk& walk, const Anatomy& anatomy) {
  double begin = spec.waypoints.front().time, end = spec.waypoints.back().time;
  for (const Person::Pointing& act : spec.acts) {
    begin = std::min(begin, act.begin);
    end = std::max(end, act.end);
  }
  for (const PersonSpec::Carrying& carrying : spec.carryings) {
    begin = std::min(begin, carrying.begin - kReachTime);
    end = std::max(end, carrying.end + kReachTime);
  }
  Poser poser(spec, walk, anatomy);
  if (spec.acts.empty() && spec.carryings.empty() && !walk.everWalks()) return {poser.next(begin)};
  const auto first = static_cast<long>(std::floor((begin - kArmRaiseTime - kTurnTime) / kPeriod)),
             last = static_cast<long>(std::ceil((end + kArmRaiseTime) / kPeriod)) + 1;
  std::vector<Posture> postures;
  for (long i = first; i <= last; ++i) postures.push_back(poser.next(static_cast<double>(i) * kPeriod));
  return postures;
}

Track trackAlong(const std::vector<Posture>& postures, const std::function<geometry::Se3(const Posture&)>& poseOf) {
  if (postures.size() == 1) return Track(poseOf(postures.front()));
  const auto areEqual = [](const Track::Place& a, const Track::Place& b) {
    return a.map_from_body->translation == b.map_from_body->translation &&
           a.map_from_body->rotation.coeffs() == b.map_from_body->rotation.coeffs();
  };
  std::vector<Track::Place> places;
  for (const Posture& posture : postures) {
    const Track::Place place{posture.time, poseOf(posture)};
    const std::size_t count = places.size();
    const bool rests = count >= 2 && areEqual(places[count - 1], place) && areEqual(places[count - 2], place);
    if (rests) places.pop_back();
    places.push_back(place);
  }
  return {Track::Kind::motion, std::move(places)};
}

}  // namespace omnimapper::sim
