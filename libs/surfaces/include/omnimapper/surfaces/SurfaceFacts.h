#pragma once

#include <omnimapper/surfaces/SurfaceSet.h>

#include <Eigen/Geometry>
#include <vector>

namespace omnimapper::surfaces {

enum class Lie { up, down, upright, leaning };

/// What is measured of a surface, by itself and by what touches it. Lengths in metres, heights above the floor.
struct SurfaceFacts {
  Lie lie = Lie::leaning;
  double bottom = 0, top = 0;
  double longer = 0, shorter = 0;  ///< sides of the least rectangle around it; of an upright one its width and height
  double filled = 0;               ///< share of that rectangle
  double before_wall = 0;  ///< of an upright one: a wall that faces the same way is so far behind it; 0 if none is near
  double plane_width = 0;  ///< of an upright one: how wide all are together that lie on its plane within 2 m of it
  bool is_at_seat = false;  ///< it touches a level surface at the height of a seat
  bool is_at_bed = false;   ///< or one of the size of a bed
  bool has_outer_corner =
      false;  ///< of an upright one: another goes on behind it at one of its ends, as sides of a box do
  bool has_inner_corner = false;  ///< or comes towards its viewer there, as the walls of a room do
  bool has_front = false;         ///< of a level one: an upright one ends below its edge
  double top_longer = 0,
         top_shorter = 0;             ///< of an upright one: sides of the level surface that begins at its upper edge
  bool is_below_level = false;        ///< a level surface hangs over it, as over what stands under a table
  bool is_on_level = false;           ///< it begins on a level surface, as what stands on a table does
  Eigen::Vector2d along{0, 0};        ///< of an upright one, where it begins and ends along the floor
  std::vector<Eigen::Vector2d> plan;  ///< its convex hull as seen from above; empty of a surface without corners
  Eigen::Vector3d middle{0, 0, 0};    ///< of its cells, in the map
};

/// In the order of `surfaces`; the z of the map is up and `floor` [m] is where people walk.
std::vector<SurfaceFacts> factsOf(const std::vector<Surface>& surfaces, double floor);

}  // namespace omnimapper::surfaces
