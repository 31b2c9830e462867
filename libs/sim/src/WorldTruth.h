#pragma once

#include <omnimapper/sim/Simulation.h>

#include <string>

namespace omnimapper::sim {

/// landmarks.json: all surfaces with labels, planes and outlines, rooms, signs, markers, points, objects with their
/// poses over time, and people. All is in the map's frame, in metres and seconds since the start.
std::string landmarksJson(const Simulation& simulation);

}  // namespace omnimapper::sim
