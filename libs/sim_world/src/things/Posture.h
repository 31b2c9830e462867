#pragma once

#include <omnimapper/sim_world/Skeleton.h>

#include <functional>
#include <optional>
#include <vector>

#include "Walk.h"

namespace omnimapper::sim {

/// How a person stands at one time.
struct Posture {
  double time = 0;
  Skeleton in_map;
  double yaw = 0;                       // of the body [rad]
  double lean = 0;                      // of the trunk, forward [rad]
  double head_yaw = 0, head_pitch = 0;  // where it looks, pitch up [rad]
  double left_foot_yaw = 0, right_foot_yaw = 0;
  std::optional<geometry::Se3> map_from_held;  // of an object that hands are busy with
};

/// Postures at every 0.05 s, from before the first walk or act to after the last.
std::vector<Posture> posturesOf(const PersonSpec& spec, const Walk& walk, const Anatomy& anatomy);

/// The track of something that moves with a person, posture by posture. While it rests, only the first and the last
/// place are kept.
Track trackAlong(const std::vector<Posture>& postures, const std::function<geometry::Se3(const Posture&)>& poseOf);

}  // namespace omnimapper::sim
