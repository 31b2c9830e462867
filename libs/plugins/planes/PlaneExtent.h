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
/// [m] between corners; a surface that reaches farther, such as the ground of a field, is known by its hull alone.
constexpr double kLargestCounted = 100;

/// The convex hull of points, dropped on a plane [m, PlaneAxes].
std::vector<Eigen::Vector2d> hullOn(const landmarks::PlaneAxes& axes, const std::vector<Eigen::Vector3d>& points);

/// What the patches of planes cover together, dropped on a plane [m, PlaneAxes]; lines cover nothing.
geometry::Areas2 seenOn(const landmarks::PlaneAxes& axes, const std::vector<SurfacePatch>& patches,
                        const map::KeyFrames& key_frames);

/// The diagonal of the box around points [m]; 0 of none.
double extentOf(const std::vector<Eigen::Vector3d>& points);

/// Sets the cells that the patches of planes cover, dropped on a plane; the grid grows as far as they reach. Coarser
/// and far quicker than seenOn(). Nothing where that would reach farther than kLargestCounted.
void addSeen(surfaces::CellGrid& cells, const geometry::Plane3& plane, const std::vector<SurfacePatch>& patches,
             const map::KeyFrames& key_frames);

/// The corners of patches in the map, each where its key frame is now.
std::vector<Eigen::Vector3d> cornersInMap(const std::vector<SurfacePatch>& patches, const map::KeyFrames& key_frames);

}  // namespace omnimapper::plugins
