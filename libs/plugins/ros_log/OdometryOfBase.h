#pragma once

#include <cstdint>
#include <string>

#include "Plan.h"
#include "ReorderBuffer.h"
#include "Transforms.h"

namespace omnimapper::ros {

/// Makes odometry of other frames of the robot that of its base. A mapper uses the odometry that comes first, so
/// nothing is taken before the first of the planned odometry.
class OdometryOfBase {
 public:
  /// `plan` must outlive this object.
  explicit OdometryOfBase(const Plan& plan) : plan_(plan) {}

  /// Moves the observation of `waiting` to the base. Its speed is that of its own frame, and is left out if the frame
  /// changes. Returns why the observation is left out; empty if it is taken.
  std::string move(const Waiting& waiting, const Transforms& transforms);

 private:
  const Plan& plan_;
  std::int64_t last_transform_ = 0;  // [ns since 1970]
  bool has_planned_ = false;
};

}  // namespace omnimapper::ros
