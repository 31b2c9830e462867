#include "FaceView.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "Frame.h"

namespace omnimapper::sim {

namespace {

constexpr int kSamples = 5;  // rays along each side of a face, to find what hides it

/// Rays to points of the face that lie in the picture.
std::vector<Ray> raysTo(const Eye& eye, const Face& face) {
  const Eigen::Vector3d& from = eye.view.map_from_optical.translation;
  const geometry::Se3 optical_from_map = geometry::inverse(eye.view.map_from_optical);
  std::vector<Ray> rays;
  for (int row = 0; row < kSamples; ++row) {
    for (int column = 0; column < kSamples; ++column) {
      const double x = (column + 0.5) / kSamples - 0.5, y = (row + 0.5) / kSamples - 0.5;
      const Eigen::Vector3d in_map = face.map_from_face * Eigen::Vector3d(x * face.width, y * face.height, 0);
      const auto pixel = eye.view.camera.project(optical_from_map * in_map);
      if (pixel && eye.view.camera.contains(*pixel)) rays.push_back({from, (in_map - from).normalized()});
    }
  }
  return rays;
}

double visiblePart(const Eye& eye, const Face& face) {
  const std::vector<Ray> rays = raysTo(eye, face);
  std::vector<Hit> hits;
  eye.scene.cast(rays, hits);
  int visible = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const bool is_glass = hits[i].isHit() && eye.scenes.material(hits[i].surface).transmission > 0;
    const Hit hit = is_glass ? castThroughGlass(eye.scenes, eye.scene, rays[i]).first : hits[i];
    visible += hit.surface >= face.first_surface && hit.surface < face.past;
  }
  return static_cast<double>(visible) / (kSamples * kSamples);
}

}  // namespace

std::optional<FaceView> viewOf(const Eye& eye, const Face& face) {
  const geometry::Se3 optical_from_face = geometry::inverse(eye.view.map_from_optical) * face.map_from_face;
  const Eigen::Vector3d normal = optical_from_face.rotation * Eigen::Vector3d::UnitZ();
  FaceView face_view;
  face_view.distance = optical_from_face.translation.norm();
  const double cosine = -normal.dot(optical_from_face.translation) / face_view.distance;
  if (!(cosine > 0)) return {};
  face_view.incidence = std::acos(std::min(1.0, cosine));
  face_view.is_whole = true;
  std::size_t corner = 0;
  for (const auto& [x, y] : {std::pair{-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}}) {
    const Eigen::Vector3d in_face(x * face.width, y * face.height, 0);
    const auto pixel = eye.view.camera.project(optical_from_face * in_face);
    if (!pixel) return {};
    face_view.corners[corner++] = *pixel;
    face_view.is_whole = face_view.is_whole && eye.view.camera.contains(*pixel);
  }
  face_view.visible = visiblePart(eye, face);
  if (face_view.visible <= 0) return {};
  return face_view;
}

std::map<std::string, BodyAt> bodiesByName(const World& world) {
  std::map<std::string, BodyAt> bodies;
  int next = 0;
  for (const Body& body : world.bodies) {
    const int first = next;
    next += static_cast<int>(body.surfaces.size());
    bodies[body.name] = {&body, first, next};
  }
  return bodies;
}

}  // namespace omnimapper::sim
