#pragma once

#include <omnimapper/building/Storey.h>

#include <string>

namespace omnimapper::building {

/// A floor plan as SVG, y upwards, 40 px a metre: outlines of the rooms as walls, passages as gaps in them, numbers and
/// areas, and a scale.
std::string encodePlan(const Storey& storey);

}  // namespace omnimapper::building
