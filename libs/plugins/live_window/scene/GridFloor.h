#pragma once

#include <mrpt/opengl/CSetOfTriangles.h>
#include <omnimapper/derived/ScanGrid.h>

namespace omnimapper::plugins {

/// The grid as flat stripes in a 3D scene at height `z` [m]: free space light, walls dark, unknown cells not drawn.
/// Stripes are used because MRPT draws textured planes over everything else in a scene, even over objects in front of
/// them.
mrpt::opengl::CSetOfTriangles::Ptr gridFloor(const derived::ScanGrid& grid, double z);

}  // namespace omnimapper::plugins
