#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/sim_world/World.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <vector>

namespace omnimapper::sim {

/// A flat stretch of a surface of a body: the top of a table, one side of a box.
struct Patch {
  int body = 0;                    ///< into World::bodies
  int surface = 0;                 ///< number as numberSurfaces() counts
  std::string name;                ///< that of the surface; "#2" behind it of the second of several, and so on
  geometry::Plane3 plane_in_body;  ///< the normal points out of the solid
  surfaces::FlatPart part_in_body;
};

/// All flat stretches over `least` [m^2], in the order of surfaces. Triangles of one surface that lie on one plane and
/// share a corner are one stretch; faces that touch without a common corner, as of two boxes of one body side by side,
/// are two. Facets of round things, which meet a neighbour at less than 40 deg, are none.
std::vector<Patch> findPatches(const World& world, double least = 0.05);

}  // namespace omnimapper::sim
