#pragma once

#include <omnimapper/sim_world/World.h>

#include <ostream>

namespace omnimapper::sim {

/// Writes all triangles at time 0 as a binary PLY, in the map [m]. "surface" of a face is its label in landmarks.json,
/// "class" the index of its class in surfaces::allSurfaceClasses(), which comments in the file list.
void writeMesh(std::ostream& out, const World& world);

/// Writes the triangles of one body as a binary PLY, in the body's frame [m]. Triangles without an area are left
/// out.
void writeMesh(std::ostream& out, const Body& body);

}  // namespace omnimapper::sim
