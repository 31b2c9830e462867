#pragma once

#include <omnimapper/building/Storey.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace omnimapper::building {

/// A piece of furniture from above.
struct PlannedThing {
  std::string name;                      ///< "bed"
  std::vector<Eigen::Vector2d> corners;  ///< counter-clockwise [m]
};

/// What a plan shows beside rooms and passages, in the frame of the map.
struct PlanContents {
  std::vector<PlannedThing> things;
  std::vector<geometry::Segment2> leaves;   ///< door leaves that were seen, open or closed
  std::vector<geometry::Segment2> windows;  ///< in the line of their walls
};

/// A floor plan as an architect draws it, as SVG, 40 px a metre, turned so that the walls are level and upright: walls
/// with thickness (straightOutlines()), passages as gaps in them, leaves with their swing, windows, furniture, names
/// and areas of rooms, and a scale. A leaf hangs at the nearer end of the passage beside it; a leaf that is beside none
/// is a closed door in its wall.
std::string encodePlan(const Storey& storey, const PlanContents& contents = {});

}  // namespace omnimapper::building
