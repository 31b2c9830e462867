#pragma once

#include <functional>
#include <vector>

#include "SampledImages.h"
#include "WallTrack.h"

namespace omnimapper::check {

/// What is known of the surroundings and the motion of a camera's base at a time.
struct CameraWitness {
  bool sees_walls = false;                                    ///< there is a laser
  std::function<std::vector<BaseWall>(base::Stamp)> walls;    ///< that the laser sees
  std::function<std::optional<double>(base::Stamp)> turning;  ///< [rad/s] of the base
};

/// Measures where a depth camera is on the base of a robot, and the scale, focal length and clock of its images, from
/// the planes in them. The floor is the plane that most images show at one and the same place in the camera's frame.
/// The other planes that are upright then must lie on walls of the laser: every pair of a plane and a wall votes for
/// a yaw and a scale, and the true pairs are those that agree. Where few planes agree, other explanations are tried:
/// depths in other units, ranges instead of depths, mirrored images, another clock. From the true pairs yaw, clock and
/// focal length follow by least squares, because they turn a plane alike in all images, by the turn rate of the base,
/// and by how obliquely the camera sees it. All `images` are of one camera, at least one.
CameraFacts fitCamera(const std::vector<SampledImage>& images, const CameraWitness& witness);

}  // namespace omnimapper::check
