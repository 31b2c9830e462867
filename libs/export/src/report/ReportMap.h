#pragma once

#include <omnimapper/map/DenseTrajectory.h>

#include <string>
#include <vector>

#include "grid/GridPicture.h"
#include "plan/LandmarkShapes.h"
#include "run/Closures.h"

namespace omnimapper::exports {

/// The map of the report: an inline SVG in pixels of the embedded picture, with landmarks, trajectory, start, end and
/// closures over it. Landmarks show their properties under the pointer, and closures their reasons. At most
/// `max_refused` refused closures are drawn; if there are more, the legend says so.
std::string drawReportMap(const GridPicture& grid, const std::vector<ShapedLandmark>& landmarks,
                          const std::vector<map::StampedPose>& trajectory, const std::vector<Closure>& closures,
                          std::size_t max_refused);

}  // namespace omnimapper::exports
