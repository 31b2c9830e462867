#pragma once

#include <omnimapper/sim_world/World.h>

#include <cmath>
#include <string>
#include <vector>

/// Worlds made by hand, quad by quad.
namespace small_worlds {

using namespace omnimapper;

inline geometry::Se3 at(double x, double y, double z = 0, double yaw = 0) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())), {x, y, z}};
}

/// A parallelogram from a corner along two edges; its normal is along first x second.
inline void addQuad(sim::World& world, const std::string& name, sim::SurfaceKind kind, const Eigen::Vector3d& corner,
                    const Eigen::Vector3d& first, const Eigen::Vector3d& second, const sim::Material& material = {}) {
  sim::Body body;
  body.name = name;
  body.vertices_in_body = {corner, corner + first, corner + first + second, corner + second};
  const Eigen::Vector2f bottom_left(0, 0), bottom_right(1, 0), top_right(1, 1), top_left(0, 1);
  body.triangles = {{{0, 1, 2}, 0, {bottom_left, bottom_right, top_right}},
                    {{0, 2, 3}, 0, {bottom_left, top_right, top_left}}};
  const Eigen::Vector3d normal = first.cross(second).normalized();
  body.surfaces.push_back(
      {name, kind, material, sim::PlanarFace{geometry::Plane3::through(corner, normal), body.vertices_in_body, {}}});
  world.bodies.push_back(std::move(body));
}

/// A wall without thickness from a to b that faces right, seen along it, with an obstacle of 2 cm around it.
inline void addWall(sim::World& world, const std::string& name, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                    const sim::Material& material = {}, double height = 2.5) {
  addQuad(world, name, sim::SurfaceKind::wall, {a.x(), a.y(), 0}, {b.x() - a.x(), b.y() - a.y(), 0}, {0, 0, height},
          material);
  const Eigen::Vector2d along = (b - a).normalized() * 0.01, across(-along.y(), along.x());
  world.obstacles.push_back({a - along + across, a - along - across, b + along - across, b + along + across});
}

/// A box that stands on the floor.
inline void addBox(sim::World& world, const std::string& name, const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                   double height = 1, const sim::Material& material = {}) {
  const std::vector<Eigen::Vector2d> corners{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % 4];
    addQuad(world, name + "/" + std::to_string(i), sim::SurfaceKind::clutter, {a.x(), a.y(), 0},
            {b.x() - a.x(), b.y() - a.y(), 0}, {0, 0, height}, material);
  }
  world.obstacles.push_back(corners);
}

inline void addRoom(sim::World& world, const std::string& name, const Eigen::Vector2d& low,
                    const Eigen::Vector2d& high) {
  sim::Room room;
  room.name = name;
  room.outline = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  addQuad(world, name + "/floor", sim::SurfaceKind::floor, {low.x(), low.y(), 0}, {high.x() - low.x(), 0, 0},
          {0, high.y() - low.y(), 0});
  world.rooms.push_back(room);
}

/// One room of this size with its corner at the origin.
inline sim::World oneRoom(double width, double depth) {
  sim::World world;
  addRoom(world, "room", {0, 0}, {width, depth});
  addWall(world, "south", {width, 0}, {0, 0});
  addWall(world, "east", {width, depth}, {width, 0});
  addWall(world, "north", {0, depth}, {width, depth});
  addWall(world, "west", {0, 0}, {0, depth});
  return world;
}

/// Two rooms of 4 x 4 m, left and right of a wall at x = 4 with a door from y = 1.5 to 2.4; a third without a door.
inline sim::World threeRooms() {
  sim::World world;
  addRoom(world, "left", {0, 0}, {4, 4});
  addRoom(world, "right", {4, 0}, {8, 4});
  addRoom(world, "closed", {8, 0}, {11, 4});
  addWall(world, "south", {11, 0}, {0, 0});
  addWall(world, "north", {0, 4}, {11, 4});
  addWall(world, "west", {0, 0}, {0, 4});
  addWall(world, "between_1", {4, 0}, {4, 1.5});
  addWall(world, "between_2", {4, 2.4}, {4, 4});
  addWall(world, "to_closed", {8, 0}, {8, 4});
  addWall(world, "east", {11, 4}, {11, 0});
  return world;
}

}  // namespace small_worlds
