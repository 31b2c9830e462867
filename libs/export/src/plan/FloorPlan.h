#pragma once

#include <omnimapper/map/Landmark.h>

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace omnimapper::exports {

using PlanPoint = Eigen::Vector2d;                 ///< x y of the map [m]
using PlanLine = std::pair<PlanPoint, PlanPoint>;  ///< from, to
using PlanArea = std::vector<PlanPoint>;           ///< counter-clockwise; the last corner joins the first

/// A landmark seen from above.
struct PlanShape {
  std::vector<PlanLine> lines;  ///< lines, and of upright surfaces the line they stand on
  std::vector<PlanArea> areas;  ///< of all other surfaces, without their holes
  std::vector<PlanPoint> points;
};

/// What is less than a millimetre long or wide from above is no line and no area; an upright line is a point.
PlanShape fromAbove(const map::LandmarkShape& shape);

/// Twice the area of a closed walk; positive if it goes counter-clockwise.
double doubledArea(const PlanArea& walk);

/// The dashes of a broken line of that length, as parts of it from 0 to 1; it begins and ends with a dash.
std::vector<std::pair<double, double>> dashesOf(double length, double dash);

}  // namespace omnimapper::exports
