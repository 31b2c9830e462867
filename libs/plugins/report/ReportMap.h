#pragma once

#include <omnimapper/derived/Closures.h>
#include <omnimapper/derived/GridPicture.h>
#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/map/DenseTrajectory.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// The map of the report: an inline SVG in pixels of the embedded picture, with landmarks, trajectory, start, end and
/// closures over it. Landmarks show their properties under the pointer, and closures their reasons. At most
/// `max_refused` refused closures are drawn; if there are more, the legend says so.
std::string drawReportMap(const derived::GridPicture& grid, const std::vector<derived::ShapedLandmark>& landmarks,
                          const std::vector<map::StampedPose>& trajectory,
                          const std::vector<derived::Closure>& closures, std::size_t max_refused);

}  // namespace omnimapper::plugins
