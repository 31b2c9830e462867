#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// One flat side of a wall, seen from its room: u runs from the left end to the right, z up.
struct WallFace {
  /// The hole of an opening.
  struct Hole {
    double low_u = 0, high_u = 0;  ///< [m]
    double low_z = 0, high_z = 0;  ///< in the map [m]
    bool is_from_floor = true;     ///< its bottom is the floor, whatever low_z is
  };
  int room = 0;
  std::string surface;                        ///< its name, "kitchen/wall_2"
  Eigen::Vector2d start, direction;           ///< in the map; direction is unit
  double length = 0;                          ///< [m]
  double floor_start = 0, floor_end = 0;      ///< z of the floor at both ends [m]
  double ceiling_start = 0, ceiling_end = 0;  ///< z of the ceiling at both ends [m]
  std::vector<Hole> holes;                    ///< in order of u
  double solid = 0.3;                         ///< thickness of the wall behind this side [m]

  Eigen::Vector2d inward() const { return {direction.y(), -direction.x()}; }  ///< into the room
  Eigen::Vector2d end() const { return start + length * direction; }
  double alongOf(const Eigen::Vector2d& in_map) const { return direction.dot(in_map - start); }
  /// Signed distance, positive in front of the wall and negative in its solid [m].
  double distanceTo(const Eigen::Vector2d& in_map) const { return inward().dot(in_map - start); }
  double floorAt(double u) const { return floor_start + (floor_end - floor_start) * u / length; }
  double ceilingAt(double u) const { return ceiling_start + (ceiling_end - ceiling_start) * u / length; }
  Eigen::Vector3d at(double u, double z) const;
};

}  // namespace omnimapper::sim
