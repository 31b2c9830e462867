#pragma once

#include <Eigen/Core>
#include <optional>

namespace omnimapper::interaction {

/// A joint that a tracker saw or guessed.
struct BodyJoint {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< [m]
  bool is_guessed = false;                       ///< hidden or out of view, and therefore less accurate
};

struct BodyArm {
  std::optional<BodyJoint> shoulder, elbow, hand;
};

/// The joints of one person that pointing needs, in a frame whose z points up. Left and right are those of the person.
/// Joints that the tracker does not know are absent.
struct TrackedBody {
  std::optional<BodyJoint> head, neck, torso;
  BodyArm left, right;
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< where the tracker is [m]

  const BodyArm& arm(bool right_arm) const { return right_arm ? right : left; }
};

/// The middle of the body: of torso, neck, head and shoulders the first that is known, or else none.
std::optional<Eigen::Vector3d> middleOf(const TrackedBody& body);

/// Whether the shoulders say that the person looks away from the sensor. A tracker that mirrors people says the same of
/// somebody who looks at it. False if a shoulder is not known.
bool looksAway(const TrackedBody& body);

/// The body in another frame whose z points up.
template <class Pose>
TrackedBody transformed(const Pose& to_from_body, TrackedBody body) {
  const auto move = [&](std::optional<BodyJoint>& joint) {
    if (joint) joint->at = to_from_body * joint->at;
  };
  for (auto* joint : {&body.head, &body.neck, &body.torso}) move(*joint);
  for (auto* arm : {&body.left, &body.right})
    for (auto* joint : {&arm->shoulder, &arm->elbow, &arm->hand}) move(*joint);
  body.sensor = to_from_body * body.sensor;
  return body;
}

}  // namespace omnimapper::interaction
