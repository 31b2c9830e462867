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

/// Functions that add shapes of observations and landmarks to MRPT's scenes. Shapes that are not finite are left out.

mrpt::img::TColor asColor(const Rgb& colour);

bool isFinite(const Eigen::Vector3d& point);
/// Adds a line if both ends are finite.
void addLine(mrpt::opengl::CSetOfLines& lines, const Eigen::Vector3d& from, const Eigen::Vector3d& to);
void addClosed(mrpt::opengl::CSetOfLines& lines, const geometry::Polygon3& polygon);
/// An object for lines of this colour and width [px], without lines yet.
mrpt::opengl::CSetOfLines::Ptr makeLines(const mrpt::img::TColor& colour, float width);

/// Adds a line of that width [m], made of triangles, because many graphics drivers draw all lines one pixel wide.
void addStroke(mrpt::opengl::CSetOfTriangles& strokes, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
               double width);

/// Triangles that fill the area inside an odd number of the polygons, which lie on or near `plane`; none if nothing is
/// finite.
mrpt::opengl::CSetOfTriangles::Ptr filled(const geometry::Plane3& plane,
                                          const std::vector<geometry::Polygon3>& polygons);
/// Adds the area that filled() returns to a scene, in a translucent colour.
void addFilled(mrpt::opengl::CSetOfObjects& scene, const geometry::Plane3& plane,
               const std::vector<geometry::Polygon3>& polygons, const mrpt::img::TColor& colour);
void addArrow(mrpt::opengl::CSetOfObjects& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
              const mrpt::img::TColor& colour);
/// Adds a small ball.
void addBall(mrpt::opengl::CSetOfObjects& scene, const Eigen::Vector3d& middle, double radius,
             const mrpt::img::TColor& colour);
/// Adds a picture in space. `right` and `down` [m] are the vectors from its middle to the middles of its right and
/// lower edge.
void addPicture(mrpt::opengl::CSetOfObjects& scene, const Eigen::Vector3d& middle, const Eigen::Vector3d& right,
                const Eigen::Vector3d& down, const mrpt::img::CImage& image);
/// Adds text that always faces the viewer; MRPT draws ASCII only.
void addText(mrpt::opengl::CSetOfObjects& scene, const Eigen::Vector3d& place, const std::string& text,
             const mrpt::img::TColor& colour);

}  // namespace omnimapper::obs
