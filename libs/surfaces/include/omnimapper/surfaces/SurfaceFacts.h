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
  /// Sides of the smallest rectangle around the surface as seen from above; of an upright surface, width and height.
  double longer = 0, shorter = 0;
  double filled = 0;  ///< share of this rectangle that the surface covers
  /// For an upright surface: distance of a wall behind it that faces the same side; 0: there is none near.
  double before_wall = 0;
  /// For an upright surface: width, from end to end, of this surface and all others on its plane within 2 m of it.
  double plane_width = 0;
  bool is_at_seat = false;  ///< whether it touches a level surface at the height of a seat
  bool is_at_bed = false;   ///< whether it touches a level surface of the size of a bed
  /// For an upright surface: at one end, another surface leads away from the viewer, as the sides of a box do.
  bool has_outer_corner = false;
  /// For an upright surface: at one end, another surface leads towards the viewer, as the walls of a room do.
  bool has_inner_corner = false;
  bool has_front = false;  ///< for a level surface: the upper edge of an upright surface touches it
  /// For an upright surface: sides of the largest level surface that touches its upper edge.
  double top_longer = 0, top_shorter = 0;
  /// For an upright surface: a level surface is above it, as a table top is above an object under the table.
  bool is_below_level = false;
  bool is_on_level = false;     ///< for an upright surface: it begins on a level one, as an object on a table does
  Eigen::Vector2d along{0, 0};  ///< for an upright surface: where it begins and ends along the floor
  std::vector<Eigen::Vector2d> plan;  ///< convex hull of the surface as seen from above; empty if it has no corners
  Eigen::Vector3d middle{0, 0, 0};    ///< mean of the middles of the surface's cells, in the map
};

/// The facts about each surface, in the order of `surfaces`. The z of the map is up, and `floor` [m] is the height of
/// the floor.
std::vector<SurfaceFacts> factsOf(const std::vector<Surface>& surfaces, double floor);

}  // namespace omnimapper::surfaces
