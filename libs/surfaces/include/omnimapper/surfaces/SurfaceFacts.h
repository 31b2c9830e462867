#pragma once

#include <omnimapper/surfaces/SurfaceSet.h>

#include <Eigen/Geometry>
#include <vector>

namespace omnimapper::surfaces {

enum class Lie { up, down, upright, leaning };

/// Measurements of a surface itself and of the surfaces that touch it. Lengths in metres, heights above the floor.
struct SurfaceFacts {
  Lie lie = Lie::leaning;
  double bottom = 0, top = 0;
  double longer = 0, shorter = 0;  ///< sides of the smallest rectangle around it; of an upright one width and height
  double filled = 0;               ///< share of that rectangle that it covers
  double before_wall = 0;  ///< of an upright one: distance of a wall behind it that faces the same side; 0: none near
  double plane_width = 0;  ///< of an upright one: width of all surfaces together that lie on its plane within 2 m of it
  bool is_at_seat = false;        ///< whether it touches a level surface at the height of a seat
  bool is_at_bed = false;         ///< whether it touches a level surface of the size of a bed
  bool has_outer_corner = false;  ///< of an upright one: another continues behind it at an end, as sides of a box do
  bool has_inner_corner = false;  ///< of an upright one: another comes towards the viewer there, as walls of a room do
  bool has_front = false;         ///< of a level one: an upright surface ends below its edge
  double top_longer = 0,
         top_shorter = 0;             ///< of an upright one: sides of the level surface that begins at its upper edge
  bool is_below_level = false;        ///< a level surface is above it, as over an object under a table
  bool is_on_level = false;           ///< it begins on a level surface, as an object on a table does
  Eigen::Vector2d along{0, 0};        ///< of an upright one, where it begins and ends along the floor
  std::vector<Eigen::Vector2d> plan;  ///< its convex hull as seen from above; empty of a surface without corners
  Eigen::Vector3d middle{0, 0, 0};    ///< of its cells, in the map
};

/// Facts in the order of `surfaces`. The z of the map is up, and `floor` [m] is the height of the floor.
std::vector<SurfaceFacts> factsOf(const std::vector<Surface>& surfaces, double floor);

}  // namespace omnimapper::surfaces
