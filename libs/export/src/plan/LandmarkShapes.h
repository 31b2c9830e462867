#pragma once

#include <omnimapper/geometry/Plane3.h>
#include <omnimapper/plugin/State.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace omnimapper::exports {

/// A landmark with how it looks, for whoever draws, lists or exports it. Valid as long as the map is as it is.
struct ShapedLandmark {
  const map::Landmark* landmark;
  map::LandmarkShape shape;  ///< all of it finite, with a label
  bool moved = false;        ///< no longer there: the shape is where it was
  /// Whether it has any surface, line or point.
  bool isSomewhere() const { return !shape.surfaces.empty() || !shape.lines.empty() || !shape.points.empty(); }
  /// Seen so rarely that it may be noise: maps show it thin.
  bool isFaint() const { return landmark->evidence < 3; }
};

/// Whether landmarks that were seen too little to be drawn are of interest.
enum class Candidates { left_out, kept };

/// The landmarks of a map that outputs show, in the order of ids; those that were merged into another one are not. What
/// is not finite in a shape is left out, as are surfaces without area.
std::vector<ShapedLandmark> shapesOf(const mapper::State& state, Candidates candidates = Candidates::left_out);

/// How often each sensor saw it, by sensor label, as far as its payload tells.
std::map<std::string, std::size_t> seenBy(const map::LandmarkShape& shape);

/// "laser only", "kinect and laser", ...; empty if nothing is known.
std::string sensorsText(const std::map<std::string, std::size_t>& seen_by);

/// A surface of the shape, by its number, then the holes in it.
std::vector<geometry::Polygon3> withHoles(std::size_t surface, const map::LandmarkShape& shape);

/// [m^2] of all surfaces, less their holes.
double areaOf(const map::LandmarkShape& shape);
/// [m] of all lines.
double lengthOf(const map::LandmarkShape& shape);

/// The least box along the axes of the map around all of it [m]; empty if it is nowhere.
Eigen::AlignedBox3d boxOf(const map::LandmarkShape& shape);

/// The address of its photograph for pages and data (draw::pngAddress()); empty if it has none.
std::string photographAddress(const map::LandmarkShape& shape);

/// The plane of a surface, its normal on the side of `shape.normal`.
geometry::Plane3 planeOf(const geometry::Polygon3& surface, const map::LandmarkShape& shape);

}  // namespace omnimapper::exports
