#pragma once

#include <mrpt/opengl/TTriangle.h>
#include <omnimapper/derived/MapPoints.h>

#include <string>
#include <vector>

namespace omnimapper::derived {

/// The bytes of a PLY file: binary, little-endian, float x y z [m], uchar red green blue.
std::string encodePly(const std::vector<ColouredPoint>& points);
/// The same with a face for each triangle; a triangle has the colour of its first corner.
std::string encodePly(const std::vector<mrpt::opengl::TTriangle>& triangles);

}  // namespace omnimapper::derived
