#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/plugin/State.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace omnimapper::derived {

/// A landmark and its shape, for drawing, listing and exporting. Valid as long as the map does not change.
struct ShapedLandmark {
  const map::Landmark* landmark;
  map::LandmarkShape shape;  ///< with finite coordinates and a label
  bool moved = false;        ///< it is no longer there: the shape shows where it was
  /// Whether it has any geometry.
  bool isSomewhere() const {
    return !shape.surfaces.empty() || !shape.lines.empty() || !shape.points.empty() || shape.box || shape.mesh;
  }
  /// Whether it was measured so rarely that it may be noise: maps draw it thin.
  bool isFaint() const { return landmark->evidence < 3; }
};

/// Whether candidates, landmarks that were seen too rarely to be drawn, are included.
enum class Candidates { left_out, kept };

/// The landmarks of a map that outputs show, in the order of ids, without those that were merged into another one,
/// or that people deleted. Parts of shapes that are not finite, and surfaces without area, are left out.
std::vector<ShapedLandmark> shapesOf(const mapper::State& state, Candidates candidates = Candidates::left_out);

/// "laser only", "kinect and laser", ...; empty if nothing is known.
std::string sensorsText(const std::map<std::string, std::uint64_t>& seen_by);

/// The outline of the surface with that index, followed by the outlines of its holes.
std::vector<geometry::Polygon3> withHoles(std::size_t surface, const map::LandmarkShape& shape);

/// [m^2] area of all surfaces without their holes.
double areaOf(const map::LandmarkShape& shape);
/// [m] length of all lines.
double lengthOf(const map::LandmarkShape& shape);

/// The smallest box along the axes of the map that contains the shape [m]; empty if it has no geometry.
Eigen::AlignedBox3d boxOf(const map::LandmarkShape& shape);

/// The one point that stands for a landmark in tables, answers and exports [m]: where it was last, if it was at several
/// places, else the centre of its surfaces, of its box, of its mesh, of its lines or of its points. The shape must have
/// geometry.
Eigen::Vector3d referencePoint(const map::LandmarkShape& shape);

/// The six faces of a box, with corners counter-clockwise as seen from outside.
std::vector<geometry::Polygon3> facesOf(const map::Box& box);

/// The photograph as a data address for pages (draw::pngAddress()); empty if there is none.
std::string photographAddress(const map::LandmarkShape& shape);

/// The plane of a surface, with its normal on the side of `shape.normal`.
geometry::Plane3 planeOf(const geometry::Polygon3& surface, const map::LandmarkShape& shape);

}  // namespace omnimapper::derived
