#pragma once

#include <omnimapper/interaction/PointingModel.h>

#include <cstddef>
#include <string>
#include <vector>

namespace omnimapper::interaction {

/// One frame of one person who points at a known target. Theta is as of a right arm.
struct PointingSample {
  std::string person, target;
  TargetDirection direction;
  PointingError elbow_hand, head_hand;
};

/// What is known of a row of the model.
struct FittedTarget {
  std::string target;
  std::size_t people = 0, frames = 0;
  /// Standard deviations of the means [rad], by the spread of the people's own means, because the frames of one person
  /// are alike; 0 with one person. `mean` of each angle is that standard deviation, and `sigma` the spread of the
  /// frames of a person about its own mean.
  RayErrors elbow_hand, head_hand;
};

struct PointingFit {
  PointingModel model;                ///< one row for each target, in the order of names, with its mean direction
  std::vector<FittedTarget> targets;  ///< the same order
};

/// Means and standard deviations of all frames of each target, as Tables 12 and 13 of the thesis, and the correlations
/// of both rays about these means. Throws Error(unreadable_input) if there is no sample, or a target has fewer than
/// two, or all samples of a target are the same.
PointingFit fitPointing(const std::vector<PointingSample>& samples);

}  // namespace omnimapper::interaction
