#include "ViewTruth.h"

#include <cmath>
#include <map>

namespace omnimapper::sim {

namespace {

constexpr int kSamples = 5;  // along each side of a face, to see what hides it

/// A rectangle that faces its reader: x to the right, y up, z to the reader, origin in the middle.
struct Face {
  geometry::Se3 map_from_face;
  double width, height;     // [m]
  int first_surface, past;  // numbers of the surfaces of its body
};

struct Eye {
  const Scenes& scenes;
  const Scene& scene;
  const Pinhole& camera;
  geometry::Se3 map_from_optical;
};

bool isSeen(const Eye& eye, const Face& face, const Eigen::Vector3d& in_face) {
  const Eigen::Vector3d in_map = face.map_from_face * in_face;
  const auto pixel = eye.camera.project(geometry::inverse(eye.map_from_optical) * in_map);
  if (!pixel || !eye.camera.contains(*pixel)) return false;
  const Eigen::Vector3d way = in_map - eye.map_from_optical.translation;
  const auto [hit, light] =
      castThroughGlass(eye.scenes, eye.scene, {eye.map_from_optical.translation, way.normalized()});
  (void)light;
  return hit.surface >= face.first_surface && hit.surface < face.past;
}

double visiblePart(const Eye& eye, const Face& face) {
  int seen = 0;
  for (int row = 0; row < kSamples; ++row) {
    for (int column = 0; column < kSamples; ++column) {
      const double x = (column + 0.5) / kSamples - 0.5, y = (row + 0.5) / kSamples - 0.5;
      seen += isSeen(eye, face, {x * face.width, y * face.height, 0});
    }
  }
  return static_cast<double>(seen) / (kSamples * kSamples);
}

// Null if nothing of it is seen.
nlohmann::ordered_json view(const Eye& eye, const Face& face) {
  const geometry::Se3 optical_from_face = geometry::inverse(eye.map_from_optical) * face.map_from_face;
  const double distance = optical_from_face.translation.norm();
  const Eigen::Vector3d normal = optical_from_face.rotation * Eigen::Vector3d::UnitZ();
  const double cosine = -normal.dot(optical_from_face.translation) / distance;
  if (!(cosine > 0)) return nullptr;
  nlohmann::ordered_json corners = nlohmann::ordered_json::array();
  for (const auto& [x, y] : {std::pair{-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}}) {
    const auto pixel = eye.camera.project(optical_from_face * Eigen::Vector3d(x * face.width, y * face.height, 0));
    if (!pixel) return nullptr;
    corners.push_back({pixel->x(), pixel->y()});
  }
  const double visible = visiblePart(eye, face);
  if (visible <= 0) return nullptr;
  return {{"corners", corners},
          {"distance_m", distance},
          {"incidence_deg", std::acos(std::min(1.0, cosine)) * 180 / M_PI},
          {"visible", visible}};
}

/// Bodies by name, with the numbers of their surfaces.
struct BodyAt {
  const Body* body;
  int first_surface;
};
std::map<std::string, BodyAt> bodiesByName(const World& world) {
  std::map<std::string, BodyAt> bodies;
  int next = 0;
  for (const Body& body : world.bodies) {
    bodies[body.name] = {&body, next};
    next += static_cast<int>(body.surfaces.size());
  }
  return bodies;
}

}  // namespace

nlohmann::ordered_json facesInView(const World& world, const Scenes& scenes, const Scene& scene, const Pinhole& camera,
                                   const geometry::Se3& map_from_optical, double time) {
  nlohmann::ordered_json faces{{"markers", nlohmann::ordered_json::array()},
                               {"signs", nlohmann::ordered_json::array()}};
  if (world.markers.empty() && world.signs.empty()) return faces;
  const Eye eye{scenes, scene, camera, map_from_optical};
  const auto bodies = bodiesByName(world);
  const auto past = [](const BodyAt& at) { return at.first_surface + static_cast<int>(at.body->surfaces.size()); };
  for (const Marker& marker : world.markers) {
    const BodyAt& at = bodies.at(marker.name);
    const auto map_from_body = at.body->track.at(time);
    if (!map_from_body) continue;
    nlohmann::ordered_json seen = view(eye, {*map_from_body, marker.side, marker.side, at.first_surface, past(at)});
    if (seen.is_null()) continue;
    seen["name"] = marker.name;
    seen["id"] = marker.id;
    faces["markers"].push_back(std::move(seen));
  }
  for (const Sign& sign : world.signs) {
    const BodyAt& at = bodies.at(sign.name);
    nlohmann::ordered_json seen = view(eye, {sign.map_from_sign, sign.width, sign.height, at.first_surface, past(at)});
    if (seen.is_null()) continue;
    seen["name"] = sign.name;
    seen["room"] = sign.room;
    seen["lines"] = sign.lines;
    faces["signs"].push_back(std::move(seen));
  }
  return faces;
}

nlohmann::ordered_json poseJson(const geometry::Se3& pose) {
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Quaterniond& q = pose.rotation;
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

}  // namespace omnimapper::sim
