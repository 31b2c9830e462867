#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/sim_world/World.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <vector>

namespace omnimapper::sim {

/// A flat connected part of a surface of a body: the top of a table, one side of a box.
struct Patch {
  int body = 0;                    ///< index into World::bodies
  int surface = 0;                 ///< number as numberSurfaces() counts
  std::string name;                ///< that of the surface; followed by "#1", "#2", ... if it has several patches
  geometry::Plane3 plane_in_body;  ///< the normal points out of the solid
  surfaces::FlatPart part_in_body;
};

/// All patches larger than `least` [m^2], in the order of surfaces. Triangles of one surface that lie on one plane and
/// share an edge are one patch. Faces that share only a corner are two patches; so are faces that touch but share no
/// corner, such as those of two boxes side by side in one body. Facets of round surfaces, which meet a neighbour at
/// less than 40 deg, are no patches.
std::vector<Patch> findPatches(const World& world, double least = 0.05);

}  // namespace omnimapper::sim
