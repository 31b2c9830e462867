#pragma once

#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/TTriangle.h>
#include <omnimapper/derived/LandmarkShapes.h>

#include <vector>

namespace omnimapper::derived {

/// Landmarks as a part of a 3D scene, one named object ("wall 0:12") for each, in the colours of LabelColours.h:
/// surfaces translucent with their outline and an arrow to the free side, lines as thick strokes, points as balls, and
/// the name if `with_names` is set. Rarely measured landmarks are fainter, without arrow and name; moved ones are
/// dashed outlines.
mrpt::opengl::CSetOfObjects::Ptr landmarkObjects(const std::vector<ShapedLandmark>& landmarks, bool with_names);

/// The landmarks as coloured triangles, for programs that read only these: surfaces, a stroke 5 cm wide for a line, an
/// octahedron for a point. Moved landmarks are left out.
std::vector<mrpt::opengl::TTriangle> landmarkTriangles(const std::vector<ShapedLandmark>& landmarks);

}  // namespace omnimapper::derived
