#include "WallThings.h"

#include <algorithm>

namespace omnimapper::sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

const std::vector<std::string>& signStyleNames() {
  static const std::vector<std::string> names{"dark", "white", "exit"};
  return names;
}

const std::vector<std::string>& posterKindNames() {
  static const std::vector<std::string> names{"poster", "notice", "extinguisher", "clock", "announcement"};
  return names;
}

SignStyle signStyleOf(const std::string& name) {
  const auto& names = signStyleNames();
  return static_cast<SignStyle>(std::find(names.begin(), names.end(), name) - names.begin());
}

const WallFace& WallSpace::wallAt(const std::string& name, const Vector2d& point) const {
  const auto room = roomAt(building_.rooms, point);
  if (!room) refuse(plan_, name, "x_m", "x_m, y_m lies in no room");
  const WallFace* best = nullptr;
  double best_distance = 0.5;
  for (const WallFace& wall : building_.walls) {
    const double u = wall.alongOf(point), distance = wall.distanceTo(point);
    // A wall that goes on through several rooms belongs to the first of them.
    if (u < 0 || u > wall.length || distance < -kFloorTolerance || distance >= best_distance) continue;
    if (!contains(building_.rooms[*room].outline, wall.start + u * wall.direction)) continue;
    best = &wall;
    best_distance = distance;
  }
  if (!best) refuse(plan_, name, "x_m", "no wall of '" + building_.rooms[*room].name + "' is within 0.5 m of x_m, y_m");
  return *best;
}

geometry::Se3 WallSpace::hang(const std::string& name, const OnWallPlan& at, double width, double height,
                              double thickness) {
  const WallFace& wall = wallAt(name, {at.x, at.y});
  const double u = wall.alongOf({at.x, at.y}), z = wall.floorAt(u) + at.z;
  const Taken mine{name, &wall, u - width / 2, u + width / 2, z - height / 2, z + height / 2};
  if (mine.low_u < 0 || mine.high_u > wall.length || mine.low_z < wall.floorAt(u) || mine.high_z > wall.ceilingAt(u))
    refuse(plan_, name, "x_m", "reaches beyond its wall '" + wall.surface + "'");
  for (const WallFace::Hole& hole : wall.holes) {
    if (mine.low_u < hole.high_u && hole.low_u < mine.high_u && mine.low_z < hole.high_z &&
        (hole.is_from_floor || hole.low_z < mine.high_z))
      refuse(plan_, name, "x_m", "hangs over an opening of '" + wall.surface + "'");
  }
  for (const Taken& other : taken_) {
    if (other.wall == &wall && mine.low_u < other.high_u && other.low_u < mine.high_u && mine.low_z < other.high_z &&
        other.low_z < mine.high_z)
      refuse(plan_, name, "x_m", "hangs over '" + other.name + "'");
  }
  taken_.push_back(mine);
  const Vector2d right = wall.direction, out = wall.inward();
  Eigen::Matrix3d axes;
  axes.col(0) = Vector3d(right.x(), right.y(), 0);
  axes.col(1) = Vector3d::UnitZ();
  axes.col(2) = Vector3d(out.x(), out.y(), 0);
  return {Eigen::Quaterniond(axes).normalized(), wall.at(u, z) + thickness * axes.col(2)};
}

}  // namespace omnimapper::sim
