#include "SignWalls.h"

#include <omnimapper/sim_world/Building.h>
#include <omnimapper/sim_world/MeshBuilder.h>
#include <omnimapper/sim_world/PosterMaking.h>

#include <cmath>

namespace omnimapper::testing {

namespace {

using namespace omnimapper::sim;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Se3;

constexpr int kObjects = 60;     // number of objects for each place
constexpr double kDepth = 0.25;  // [m] free space in front of an object on a wall

Material plain(const Eigen::Vector3f& colour) {
  Material material;
  material.colour = colour;
  return material;
}

Eigen::Vector3f greyish(Random& random, double low, double high) {
  const auto grey = static_cast<float>(random.uniform(low, high));
  return Eigen::Vector3f(grey, grey, grey * static_cast<float>(random.uniform(0.85, 1)));
}

// Whether the wall is flat and free within a rectangle around the spot.
bool isFree(const Scene& scene, const Se3& map_from_spot, double width, double height) {
  std::vector<Ray> rays;
  const Vector3d inwards = map_from_spot.rotation * -Vector3d::UnitZ();
  for (int row = -2; row <= 2; ++row) {
    for (int column = -2; column <= 2; ++column) {
      const Vector3d from(column / 3.6 * width, row / 3.6 * height, kDepth);
      rays.push_back({map_from_spot * from, inwards});
    }
  }
  std::vector<Hit> hits;
  scene.cast(rays, hits);
  for (const Hit& hit : hits) {
    if (!hit.isHit() || std::abs(hit.range - kDepth) > 1e-3) return false;
  }
  return true;
}

Se3 facing(const Vector3d& at, const Vector3d& normal) {
  Eigen::Matrix3d axes;
  axes.col(2) = normal;
  axes.col(1) = Vector3d::UnitZ();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return {Eigen::Quaterniond(axes).normalized(), at};
}

// A small fixture of a door or wall. Its frame is that of a WallSpot.
Body makeFitting(const std::string& name, int kind, const Se3& map_from_spot, Random& random) {
  MeshBuilder builder(name, Track(map_from_spot));
  const int plate = builder.addSurface("plate", SurfaceKind::object, plain(greyish(random, 0.4, 0.95)));
  const int part = builder.addSurface("part", SurfaceKind::object, plain(greyish(random, 0.03, 0.9)));
  const auto box = [&](int surface, double x, double y, double width, double height, double low, double high) {
    builder.addBox(surface, {x - width / 2, y - height / 2, low}, {x + width / 2, y + height / 2, high});
  };
  switch (kind) {
    case 0:  // one to three switches
      for (int i = 0, count = random.integer(1, 3); i < count; ++i) {
        const double x = 0.05 * (i - 0.5 * (count - 1));
        box(plate, x, 0, 0.05, 0.11, 0, 0.006);
        box(part, x, 0, 0.012, 0.025, 0.006, 0.02);
      }
      break;
    case 1:  // sockets
      box(plate, 0, 0, 0.08, 0.08, 0, 0.008);
      box(part, -0.012, 0, 0.008, 0.012, 0.008, 0.009);
      box(part, 0.012, 0, 0.008, 0.012, 0.008, 0.009);
      break;
    case 2:  // a thermostat or card reader
      box(plate, 0, 0, 0.1, random.uniform(0.07, 0.16), 0, 0.025);
      box(part, 0, 0.01, 0.06, 0.03, 0.025, 0.026);
      break;
    case 3: {  // a grille
      const double width = random.uniform(0.2, 0.5), height = random.uniform(0.12, 0.35);
      box(plate, 0, 0, width, height, 0, 0.01);
      for (double y = -height / 2 + 0.02; y < height / 2 - 0.02; y += 0.025)
        box(part, 0, y, width - 0.04, 0.012, 0.01, 0.012);
      break;
    }
    case 4:  // an empty plate
      box(plate, 0, 0, random.uniform(0.1, 0.35), random.uniform(0.1, 0.3), 0, 0.01);
      break;
    default:  // a handle with its lock
      box(plate, 0, 0, 0.05, 0.2, 0, 0.008);
      box(part, 0.05, 0.03, 0.13, 0.022, 0.03, 0.05);
      box(part, 0, 0.03, 0.02, 0.02, 0.008, 0.05);
      box(part, 0, -0.05, 0.02, 0.03, 0.008, 0.012);
  }
  return builder.build();
}

void addHandles(World& world, std::vector<WallSpot>& spots, Random& random) {
  for (const surfaces::Opening& opening : world.openings) {
    if (opening.kind != surfaces::Opening::Kind::door || opening.leaf != surfaces::Opening::Leaf::closed) continue;
    const Vector3d left = opening.rectangle[0], right = opening.rectangle[1];
    const Vector3d along = (right - left).normalized(), normal = along.cross(Vector3d::UnitZ());
    const bool on_left = random.chance(0.5);
    // A closed door leaf is flush with the wall on the side of the first room.
    const Vector3d at =
        (on_left ? left : right) + (on_left ? 0.08 : -0.08) * along + Vector3d(0, 0, 1.05) + 0.002 * normal;
    Se3 pose = facing(at, normal);
    if (!on_left) pose.rotation = pose.rotation * Eigen::AngleAxisd(M_PI, Vector3d::UnitZ());
    world.bodies.push_back(makeFitting("handle_" + opening.name, 5, pose, random));
    spots.push_back({facing(at, normal)});
  }
}

}  // namespace

std::optional<Vector3d> standpoint(const World& world, const Scene& scene, Random& random) {
  for (int attempt = 0; attempt < 50; ++attempt) {
    const Room& room =
        world.rooms[static_cast<std::size_t>(random.integer(0, static_cast<int>(world.rooms.size()) - 1))];
    Vector2d low = room.outline.front(), high = low;
    for (const Vector2d& corner : room.outline) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    const Vector2d at(random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y()));
    if (!roomAt({room}, at)) continue;
    const Vector3d eye(at.x(), at.y(), room.floorAt(at) + random.uniform(1.0, 1.7));
    bool is_free = true;
    for (int i = 0; i < 8 && is_free; ++i) {
      const Vector3d direction(std::cos(i * M_PI / 4), std::sin(i * M_PI / 4), 0);
      is_free = scene.cast(Ray{eye, direction}).range > 0.3;
    }
    if (is_free) return eye;
  }
  return {};
}

std::vector<WallSpot> addWallObjects(World& world, Random random) {
  std::vector<WallSpot> spots;
  const Scenes scenes(world);
  const Scene scene = scenes.at(0);
  std::vector<Body> bodies;
  const auto isFarFromOthers = [&](const Vector3d& at) {
    for (const WallSpot& spot : spots) {
      if ((spot.map_from_spot.translation - at).norm() < 0.6) return false;
    }
    return true;
  };
  for (int attempt = 0; attempt < 40 * kObjects && static_cast<int>(spots.size()) < kObjects; ++attempt) {
    const auto eye = standpoint(world, scene, random);
    if (!eye) continue;
    const double turn = random.uniform(0, 2 * M_PI);
    Ray ray{*eye, {std::cos(turn), std::sin(turn), 0}};
    ray.origin_in_map.z() += random.uniform(-0.2, 0.3);
    // Some objects are beside a sign, where people look for one.
    if (!world.signs.empty() && random.chance(0.4)) {
      const Sign& sign =
          world.signs[static_cast<std::size_t>(random.integer(0, static_cast<int>(world.signs.size()) - 1))];
      const Vector3d aside(random.uniform(-1.6, 1.6), random.uniform(-0.5, 0.4), 0.4);
      ray = {sign.map_from_sign * aside, sign.map_from_sign.rotation * -Vector3d::UnitZ()};
    }
    const Hit hit = scene.cast(ray);
    if (!hit.isHit() || std::abs(hit.normal_in_map.z()) > 1e-3 ||
        !isFarFromOthers(ray.origin_in_map + hit.range * ray.direction_in_map))
      continue;
    const Se3 spot = facing(ray.origin_in_map + hit.range * ray.direction_in_map, hit.normal_in_map);
    const std::string name = "thing_" + std::to_string(spots.size());
    const int kind = random.integer(0, 9);
    if (kind < 5) {
      if (!isFree(scene, spot, kind == 3 ? 0.55 : 0.37, 0.37)) continue;
      bodies.push_back(makeFitting(name, kind, spot, random));
    } else {
      PosterSpec poster;
      poster.name = name;
      poster.kind = kind <= 6   ? PosterKind::notice
                    : kind == 7 ? PosterKind::poster
                    : kind == 8 ? PosterKind::clock
                                : PosterKind::extinguisher;
      poster.seed = random.bits();
      if (poster.kind == PosterKind::notice || poster.kind == PosterKind::poster) {
        const double scale = random.uniform(0.5, 1.1);
        poster.width = scale * (poster.kind == PosterKind::notice ? 0.297 : 0.42);
        poster.height = scale * (poster.kind == PosterKind::notice ? 0.21 : 0.59);
      }
      if (!isFree(scene, spot, 0.5, 0.7)) continue;
      poster.map_from_poster = spot;
      poster.map_from_poster.translation += kPosterThickness * hit.normal_in_map;
      bodies.push_back(makePoster(poster));
    }
    spots.push_back({spot});
  }
  for (Body& body : bodies) world.bodies.push_back(std::move(body));
  addHandles(world, spots, random);
  return spots;
}

}  // namespace omnimapper::testing
