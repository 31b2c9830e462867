#pragma once

#include <omnimapper/sim_world/World.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

struct PlanDrawingOptions {
  double pixels_per_metre = 60;
  double time = 0;                                              ///< bodies are drawn where they are at this time [s]
  std::vector<Eigen::Vector2d> path;                            ///< a robot's path, drawn if it is not empty [m]
  std::vector<std::vector<Eigen::Vector2d>> paths_of_people{};  ///< [m]
};

/// The world from above, y up, as the text of an SVG picture: floors with names, walls with openings and leaves,
/// furniture, objects, door signs, posters, markers, landmarks, and a scale.
std::string drawPlan(const World& world, const PlanDrawingOptions& options = {});

}  // namespace omnimapper::sim
