#pragma once

#include <string>
#include <vector>

#include "MapPoints.h"

namespace omnimapper::plugins {

/// The bytes of a PLY file: binary, little-endian, float x y z [m], uchar red green blue.
std::string encodePly(const std::vector<ColouredPoint>& points);

}  // namespace omnimapper::plugins
