#pragma once

#include <omnimapper/geometry/PolygonBooleans.h>
#include <omnimapper/map/KeyFrames.h>
#include <omnimapper/plane_factors/PlaneAxes.h>
#include <omnimapper/surfaces/CellGrid.h>

#include <Eigen/Core>
#include <vector>

#include "PlanePayload.h"

namespace omnimapper::plugins {

constexpr double kSeenCell = 0.05;  ///< [m] side of the cells in which the area of a surface is counted
/// [m] Largest extent of a surface that is counted in cells. Of a larger surface, such as a field, only the hull is
/// known.
constexpr double kLargestCounted = 100;

/// The convex hull of points that are projected on a plane, in the PlaneAxes of the plane [m].
std::vector<Eigen::Vector2d> hullOn(const plane_factors::PlaneAxes& axes, const std::vector<Eigen::Vector3d>& points);

/// The union of patches that are projected on a plane, in the PlaneAxes of the plane [m]. Patches of laser lines cover
/// no area.
geometry::Areas2 seenOn(const plane_factors::PlaneAxes& axes, const std::vector<SurfacePatch>& patches,
                        const map::KeyFrames& key_frames);

/// The diagonal of the box around points [m]; 0 without points.
double extentOf(const std::vector<Eigen::Vector3d>& points);

/// Sets the cells that patches cover when they are projected on a plane. The grid grows as far as the patches reach.
/// This is coarser and much faster than seenOn(). Does nothing if the extent would exceed kLargestCounted.
void addSeen(surfaces::CellGrid& cells, const geometry::Plane3& plane, const std::vector<SurfacePatch>& patches,
             const map::KeyFrames& key_frames);

/// The corners of patches in the map, at the current poses of their key frames.
std::vector<Eigen::Vector3d> cornersInMap(const std::vector<SurfacePatch>& patches, const map::KeyFrames& key_frames);

}  // namespace omnimapper::plugins
