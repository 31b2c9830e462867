#pragma once

#include <mrpt/opengl/CSetOfTriangles.h>

#include "grid/ScanGrid.h"

namespace omnimapper::exports {

/// A grid as flat stripes of a 3D scene, at `z` [m], free light and walls dark; what is unknown is not drawn.
/// Stripes, for MRPT draws textured planes over all else of a scene, whatever is in front.
mrpt::opengl::CSetOfTriangles::Ptr gridFloor(const ScanGrid& grid, double z);

}  // namespace omnimapper::exports
