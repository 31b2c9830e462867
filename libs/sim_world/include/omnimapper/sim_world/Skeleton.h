#pragma once

#include <Eigen/Core>
#include <array>

namespace omnimapper::sim {

/// The joints of mrpt::obs::CObservationSkeleton, in its order.
enum class Joint {
  head,
  neck,
  torso,
  left_shoulder,
  left_elbow,
  left_hand,
  left_hip,
  left_knee,
  left_foot,
  right_shoulder,
  right_elbow,
  right_hand,
  right_hip,
  right_knee,
  right_foot
};
constexpr int kJointCount = 15;
constexpr std::array<const char*, kJointCount> kJointNames{
    "head",      "neck",           "torso",       "left_shoulder", "left_elbow", "left_hand",  "left_hip",  "left_knee",
    "left_foot", "right_shoulder", "right_elbow", "right_hand",    "right_hip",  "right_knee", "right_foot"};

/// The position of each joint [m].
struct Skeleton {
  std::array<Eigen::Vector3d, kJointCount> places;
  Eigen::Vector3d& operator[](Joint joint) { return places[static_cast<int>(joint)]; }
  const Eigen::Vector3d& operator[](Joint joint) const { return places[static_cast<int>(joint)]; }
};

/// The joint of a limb on the left or right side.
enum class Limb { shoulder, elbow, hand, hip, knee, foot };
inline Joint jointOf(bool right, Limb limb) {
  return static_cast<Joint>(static_cast<int>(right ? Joint::right_shoulder : Joint::left_shoulder) +
                            static_cast<int>(limb));
}

/// Lengths of a person's body, after Drillis and Contini as parts of the height [m].
struct Anatomy {
  explicit Anatomy(double height) : height(height) {}
  double height;
  double ankle_z = 0.039 * height, thigh = 0.245 * height, shin = 0.246 * height, half_hips = 0.05 * height;
  double standing_hip_z = 0.525 * height;                      // knees hardly bent
  double upper_arm = 0.186 * height, forearm = 0.19 * height;  // to the middle of the palm
  double half_shoulders = 0.115 * height;
  // Heights above the hips.
  double torso_up = 0.16 * height, shoulder_up = 0.288 * height, neck_up = 0.325 * height, head_up = 0.405 * height;
};

}  // namespace omnimapper::sim
