#include "Ground.h"

#include <algorithm>

#include "RobotSpace.h"

namespace omnimapper::sim {

namespace {

bool isGround(SurfaceKind kind) {
  return kind == SurfaceKind::floor || kind == SurfaceKind::road || kind == SurfaceKind::kerb;
}

}  // namespace

Ground::Ground(const World& world) : world_(world) {
  for (const Body& body : world.bodies) {
    if (body.track.kind() != Track::Kind::steps || !body.track.at(0)) continue;
    Body part = body;
    part.triangles.erase(
        std::remove_if(part.triangles.begin(), part.triangles.end(),
                       [&](const Triangle& triangle) { return !isGround(body.surfaces[triangle.surface].kind); }),
        part.triangles.end());
    if (part.triangles.empty()) continue;
    for (const Eigen::Vector3d& vertex : part.vertices_in_body)
      above_ = std::max(above_, (*body.track.at(0) * vertex).z());
    ground_.bodies.push_back(std::move(part));
  }
  above_ += 1;
  scenes_ = std::make_unique<Scenes>(ground_);
}

Ground::~Ground() = default;

double Ground::heightAt(const Eigen::Vector2d& point) const {
  const Hit hit = scenes_->at(0).cast({{point.x(), point.y(), above_}, {0, 0, -1}});
  if (hit.isHit()) return above_ - hit.range;
  double height = 0, nearest = std::numeric_limits<double>::infinity();
  for (const Room& room : world_.rooms) {
    double distance = contains(room.outline, point) ? 0 : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; distance > 0 && i < room.outline.size(); ++i) {
      distance =
          std::min(distance, distanceToSegment(point, room.outline[i], room.outline[(i + 1) % room.outline.size()]));
    }
    if (distance < nearest) nearest = distance, height = room.floor_z;
  }
  return height;
}

}  // namespace omnimapper::sim
