#pragma once

#include <omnimapper/map/DenseTrajectory.h>

#include <string>
#include <vector>

#include "grid/GridPicture.h"
#include "plan/LandmarkShapes.h"
#include "run/Closures.h"

namespace omnimapper::exports {

/// The map of the report: the picture embedded, over it landmarks, which tell what they are under the pointer,
/// trajectory, start, end and closures as lines of an inline SVG in the picture's pixels; each closure tells its reason
/// under the pointer. Refused closures beyond `max_refused` are not drawn, and the legend says so.
std::string drawReportMap(const GridPicture& grid, const std::vector<ShapedLandmark>& landmarks,
                          const std::vector<map::StampedPose>& trajectory, const std::vector<Closure>& closures,
                          std::size_t max_refused);

}  // namespace omnimapper::exports
