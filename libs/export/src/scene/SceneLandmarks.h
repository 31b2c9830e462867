#pragma once

#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/TTriangle.h>

#include <vector>

#include "plan/LandmarkShapes.h"

namespace omnimapper::exports {

/// Landmarks as a part of a 3D scene, one named object ("wall 0:12") for each, in the colours of LandmarkColours.h:
/// surfaces translucent with their outline and an arrow to the free side, lines as thick strokes, points as balls, and
/// the name where `with_names`. What was hardly seen is fainter, without arrow and name; what has moved is an outline
/// of dashes.
mrpt::opengl::CSetOfObjects::Ptr landmarkObjects(const std::vector<ShapedLandmark>& landmarks, bool with_names);

/// What is there of the landmarks as coloured triangles, for programs that know nothing else: surfaces, a stroke 5 cm
/// wide for a line, an octahedron for a point.
std::vector<mrpt::opengl::TTriangle> landmarkTriangles(const std::vector<ShapedLandmark>& landmarks);

}  // namespace omnimapper::exports
