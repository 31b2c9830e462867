#pragma once

#include <omnimapper/map/Landmark.h>

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace omnimapper::derived {

using PlanPoint = Eigen::Vector2d;                 ///< [m] x and y in the map
using PlanLine = std::pair<PlanPoint, PlanPoint>;  ///< from, to
using PlanArea = std::vector<PlanPoint>;           ///< counter-clockwise; the last corner is connected to the first

/// A landmark seen from above.
struct PlanShape {
  std::vector<PlanLine> lines;  ///< lines, and the base lines of upright surfaces
  std::vector<PlanArea> areas;  ///< all other surfaces, without their holes
  std::vector<PlanPoint> points;
};

/// The shape from above. Lines and areas shorter or narrower than a millimetre are left out; an upright line becomes a
/// point.
PlanShape fromAbove(const map::LandmarkShape& shape);

/// Twice the area of a closed path; positive if it is counter-clockwise.
double doubledArea(const PlanArea& walk);

/// The dashes of a dashed line of that length, as fractions from 0 to 1; it begins and ends with a dash.
std::vector<std::pair<double, double>> dashesOf(double length, double dash);

}  // namespace omnimapper::derived
