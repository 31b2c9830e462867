#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/obs/IndexColour.h>
#include <omnimapper/obs/Rgb.h>

#include <string>
#include <vector>

namespace omnimapper::obs {

/// Shapes of what was observed or mapped, in MRPT's scenes. Whatever is not a finite number is left out.

mrpt::img::TColor asColor(const Rgb& colour);

bool isFinite(const Eigen::Vector3d& point);
/// Adds a line where both ends are finite.
void addLine(mrpt::opengl::CSetOfLines& lines, const Eigen::Vector3d& from, const Eigen::Vector3d& to);
void addClosed(mrpt::opengl::CSetOfLines& lines, const geometry::Polygon3& polygon);
/// Lines of that colour and width [px] as one object.
mrpt::opengl::CSetOfLines::Ptr makeLines(const mrpt::img::TColor& colour, float width);

/// Adds a line of that width [m], thick from wherever it is seen: many graphics drivers draw lines a pixel wide.
void addStroke(mrpt::opengl::CSetOfTriangles& strokes, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
               double width);

/// What lies in an odd number of the walks, all on about that plane, as triangles; none if there is nothing finite.
mrpt::opengl::CSetOfTriangles::Ptr filled(const geometry::Plane3& plane, const std::vector<geometry::Polygon3>& walks);
/// The same as a part of a scene, of a translucent colour.
void addFilled(mrpt::opengl::CSetOfObjects& scene, const geometry::Plane3& plane,
               const std::vector<geometry::Polygon3>& walks, const mrpt::img::TColor& colour);
void addArrow(mrpt::opengl::CSetOfObjects& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
              const mrpt::img::TColor& colour);
/// A small ball.
void addBall(mrpt::opengl::CSetOfObjects& scene, const Eigen::Vector3d& middle, double radius,
             const mrpt::img::TColor& colour);
/// A picture in space: `right` and `down` [m] are its edges from the middle of the picture, half as long as it is.
void addPicture(mrpt::opengl::CSetOfObjects& scene, const Eigen::Vector3d& middle, const Eigen::Vector3d& right,
                const Eigen::Vector3d& down, const mrpt::img::CImage& image);
/// Text that always faces who looks; MRPT draws ASCII.
void addText(mrpt::opengl::CSetOfObjects& scene, const Eigen::Vector3d& place, const std::string& text,
             const mrpt::img::TColor& colour);

}  // namespace omnimapper::obs
