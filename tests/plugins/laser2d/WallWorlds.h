#pragma once

// Worlds of walls for the tests of loop closures, and what a laser sees of them.
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/matching/ScanWithNormals.h>

#include <Eigen/Geometry>
#include <memory>
#include <vector>

namespace omnimapper::plugins::wall_worlds {

struct Wall {
  Eigen::Vector2d from, to;
};
using World = std::vector<Wall>;

/// Around the origin.
inline World room(double width, double height) {
  const double x = width / 2, y = height / 2;
  return {{{-x, -y}, {x, -y}}, {{x, -y}, {x, y}}, {{x, y}, {-x, y}}, {{-x, y}, {-x, -y}}};
}

inline World corridor() {
  return {{{-30, -1.2}, {30, -1.2}}, {{-30, 1.2}, {30, 1.2}}};
}

/// The points of all walls within `reach` [m], in the base: walls do not hide each other.
inline std::shared_ptr<const matching::ScanWithNormals> scanFrom(const mrpt::poses::CPose3D& map_from_base,
                                                                 const World& world, double reach) {
  constexpr double kSpacing = 0.05;  // [m]
  auto scan = std::make_shared<matching::ScanWithNormals>();
  const mrpt::poses::CPose3D base_from_map = mrpt::poses::CPose3D() - map_from_base;
  const Eigen::Rotation2Dd turn(base_from_map.yaw());
  for (const auto& wall : world) {
    const Eigen::Vector2d along = (wall.to - wall.from).normalized();
    const double length = (wall.to - wall.from).norm();
    for (double offset = 0; offset <= length; offset += kSpacing) {
      const Eigen::Vector2d p = wall.from + offset * along;
      const auto in_base = base_from_map.composePoint({p.x(), p.y(), 0});
      if (in_base.norm() > reach) continue;
      scan->points.emplace_back(in_base.x, in_base.y);
      scan->normals.push_back((turn * Eigen::Vector2d(-along.y(), along.x())).cast<float>());
    }
  }
  return scan;
}

}  // namespace omnimapper::plugins::wall_worlds
