#pragma once

#include <omnimapper/sim/Simulation.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// Draws the measurement of each camera and laser in the middle of the run into folder/pictures: colour and depth of
/// cameras, points of lasers from above (1 m squares, sensor in the middle, x to the right). Returns the files' names.
/// Throws base::Error(disk_full, unwritable_output).
std::vector<std::string> drawPictures(const Simulation& simulation, const std::string& folder);

/// The plan of the world as SVG, with the paths of the robot and of the people who accompany it until a time [s].
std::string drawnPlan(const Simulation& simulation, double duration);

}  // namespace omnimapper::sim
