#pragma once

#include <mrpt/obs/CObservationSkeleton.h>
#include <omnimapper/interaction/PointingGesture.h>

#include <Eigen/Core>
#include <functional>

namespace omnimapper::interaction {

using TrackedJoint = mrpt::obs::CObservationSkeleton::TSkeletonJoint;

inline std::vector<TrackedJoint mrpt::obs::CObservationSkeleton::*> trackedJoints() {
  using S = mrpt::obs::CObservationSkeleton;
  return {&S::head,        &S::neck,       &S::torso,     &S::left_shoulder, &S::left_elbow,
          &S::left_hand,   &S::left_hip,   &S::left_knee, &S::left_foot,     &S::right_shoulder,
          &S::right_elbow, &S::right_hand, &S::right_hip, &S::right_knee,    &S::right_foot};
}

/// A person who stands 2 m before the base and looks at it; its right arm points at the base, its left arm hangs. The
/// joints are in the base and the sensor is there, with x ahead and z up.
inline mrpt::obs::CObservationSkeleton standingPerson() {
  mrpt::obs::CObservationSkeleton s;
  const auto put = [](TrackedJoint& joint, double x, double y, double z) {
    joint.x = x, joint.y = y, joint.z = z, joint.conf = 1;
  };
  put(s.head, 2, 0, 1.6);
  put(s.neck, 2, 0, 1.4);
  put(s.torso, 2, 0, 1.15);
  put(s.left_shoulder, 2, -0.2, 1.38);
  put(s.left_elbow, 2, -0.22, 1.08);
  put(s.left_hand, 2, -0.22, 0.76);
  put(s.right_shoulder, 2, 0.2, 1.38);
  put(s.right_elbow, 1.72, 0.2, 1.33);
  put(s.right_hand, 1.4, 0.2, 1.3);
  put(s.left_hip, 2, -0.1, 0.9);
  put(s.left_knee, 2, -0.1, 0.5);
  put(s.left_foot, 2, -0.1, 0.07);
  put(s.right_hip, 2, 0.1, 0.9);
  put(s.right_knee, 2, 0.1, 0.5);
  put(s.right_foot, 2, 0.1, 0.07);
  return s;
}

/// The same with each joint moved.
inline mrpt::obs::CObservationSkeleton moved(mrpt::obs::CObservationSkeleton s,
                                             const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& move) {
  for (const auto joint : trackedJoints()) {
    const Eigen::Vector3d to = move({(s.*joint).x, (s.*joint).y, (s.*joint).z});
    (s.*joint).x = to.x(), (s.*joint).y = to.y(), (s.*joint).z = to.z();
  }
  return s;
}

}  // namespace omnimapper::interaction
