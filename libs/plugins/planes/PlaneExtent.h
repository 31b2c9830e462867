#pragma once

#include <omnimapper/geometry/PolygonBooleans.h>
#include <omnimapper/landmarks/PlaneAxes.h>
#include <omnimapper/map/KeyFrames.h>
#include <omnimapper/surfaces/CellGrid.h>

#include <Eigen/Core>
#include <vector>

#include "PlanePayload.h"

namespace omnimapper::plugins {

constexpr double kSeenCell = 0.05;  ///< [m] side of the cells that a surface is counted in
/// [m] largest extent of a surface that is counted in cells; of a larger one, such as a field, only the hull is known.
constexpr double kLargestCounted = 100;

/// The convex hull of points, projected on a plane [m, PlaneAxes].
std::vector<Eigen::Vector2d> hullOn(const landmarks::PlaneAxes& axes, const std::vector<Eigen::Vector3d>& points);

/// The union of the patches of planes, projected on a plane [m, PlaneAxes]; lines cover no area.
geometry::Areas2 seenOn(const landmarks::PlaneAxes& axes, const std::vector<SurfacePatch>& patches,
                        const map::KeyFrames& key_frames);

/// The diagonal of the box around points [m]; 0 of none.
double extentOf(const std::vector<Eigen::Vector3d>& points);

/// Sets the cells that the patches of planes cover, projected on a plane; the grid grows as far as they reach. Coarser
/// and much faster than seenOn(). Does nothing if the extent would exceed kLargestCounted.
void addSeen(surfaces::CellGrid& cells, const geometry::Plane3& plane, const std::vector<SurfacePatch>& patches,
             const map::KeyFrames& key_frames);

/// The corners of patches in the map, at the current poses of their key frames.
std::vector<Eigen::Vector3d> cornersInMap(const std::vector<SurfacePatch>& patches, const map::KeyFrames& key_frames);

}  // namespace omnimapper::plugins
