#pragma once

#include <omnimapper/interaction/PointingTarget.h>
#include <omnimapper/obs/CObservationCommand.h>
#include <omnimapper/plugin/State.h>

#include <vector>

namespace omnimapper::plugins {

/// The landmarks at which a person may point, in the map: those that outputs show and that have not moved.
struct LabelCandidates {
  std::vector<base::LandmarkId> landmarks;
  std::vector<interaction::PointedCandidate> candidates;  ///< the same order
};

/// A landmark with flat surfaces is the largest of them; one with a mesh, a box or points is an object, of at most
/// about 100 points. Walls reach up to 2.4 m. Floors and ceilings count a tenth: behind what is not mapped yet there is
/// mostly one of them. What does not fit the subject of a command may not be meant, but hides what is behind it.
LabelCandidates labelCandidates(const mapper::State& state, obs::CommandSubject subject);

/// The middle of a candidate [m].
Eigen::Vector3d middleOf(const interaction::PointedCandidate& candidate);

}  // namespace omnimapper::plugins
