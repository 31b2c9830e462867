#pragma once

#include <omnimapper/landmarks/PlaneAxes.h>
#include <omnimapper/map/KeyFrames.h>

#include <Eigen/Core>
#include <vector>

#include "PlanePayload.h"

namespace omnimapper::plugins {

/// The convex hull of points, dropped on a plane [m, PlaneAxes].
std::vector<Eigen::Vector2d> hullOn(const landmarks::PlaneAxes& axes, const std::vector<Eigen::Vector3d>& points);

/// The outlines of what the patches of planes cover together, dropped on a plane [m, PlaneAxes]; lines cover nothing.
std::vector<std::vector<Eigen::Vector2d>> seenOn(const landmarks::PlaneAxes& axes,
                                                 const std::vector<SurfacePatch>& patches,
                                                 const map::KeyFrames& key_frames);

/// The corners of patches in the map, each where its key frame is now.
std::vector<Eigen::Vector3d> cornersInMap(const std::vector<SurfacePatch>& patches, const map::KeyFrames& key_frames);

}  // namespace omnimapper::plugins
