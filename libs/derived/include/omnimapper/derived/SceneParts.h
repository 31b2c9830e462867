#pragma once

#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <omnimapper/derived/Closures.h>
#include <omnimapper/derived/MapPoints.h>
#include <omnimapper/map/DenseTrajectory.h>

#include <vector>

namespace omnimapper::derived {

/// Parts of a 3D scene of a map, for the file and for the live window.

/// A grid of lines on the ground under the trajectory and 5 m around it, with a round spacing.
mrpt::opengl::CGridPlaneXY::Ptr groundOf(const map::Map& map);
/// The trajectory as lines, in the colours of SessionColours.h: "newest session", and "earlier sessions" if there are
/// any.
mrpt::opengl::CSetOfObjects::Ptr trajectoryLines(const std::vector<map::StampedPose>& trajectory);
/// Axes of key frames that are at least `spacing` [m] of travel apart, and of the newest one.
mrpt::opengl::CSetOfObjects::Ptr keyFrameCorners(const map::Map& map, double spacing);
/// Lines of the accepted closures, or of the refused ones.
mrpt::opengl::CSetOfLines::Ptr closureLines(const std::vector<Closure>& closures, bool accepted);
mrpt::opengl::CPointCloudColoured::Ptr cloudOf(const std::vector<ColouredPoint>& points);

}  // namespace omnimapper::derived
