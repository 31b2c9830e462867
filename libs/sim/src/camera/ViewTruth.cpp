#include "ViewTruth.h"

#include <cmath>

#include "FaceView.h"

namespace omnimapper::sim {

namespace {

nlohmann::ordered_json toJson(const FaceView& view) {
  nlohmann::ordered_json corners = nlohmann::ordered_json::array();
  for (const Eigen::Vector2d& corner : view.corners) corners.push_back({corner.x(), corner.y()});
  return {{"corners", corners},
          {"distance_m", view.distance},
          {"incidence_deg", view.incidence * 180 / M_PI},
          {"visible", view.visible}};
}

}  // namespace

nlohmann::ordered_json facesInView(const World& world, const Scenes& scenes, const Scene& scene, const CameraView& view,
                                   const std::vector<SignView>& signs) {
  nlohmann::ordered_json faces{{"markers", nlohmann::ordered_json::array()},
                               {"signs", nlohmann::ordered_json::array()}};
  const auto bodies = world.markers.empty() ? std::map<std::string, BodyAt>() : bodiesByName(world);
  for (const Marker& marker : world.markers) {
    const BodyAt& at = bodies.at(marker.name);
    const auto map_from_body = at.body->track.at(view.time);
    if (!map_from_body) continue;
    const auto face_view =
        viewOf({scenes, scene, view}, {*map_from_body, marker.side, marker.side, at.first_surface, at.past});
    if (!face_view) continue;
    faces["markers"].push_back(toJson(*face_view));
    faces["markers"].back()["name"] = marker.name;
    faces["markers"].back()["id"] = marker.id;
  }
  for (const SignView& sign_view : signs) {
    const Sign& sign = world.signs[static_cast<std::size_t>(sign_view.sign)];
    nlohmann::ordered_json json = toJson(sign_view);
    json["name"] = sign.name;
    json["room"] = sign.room;
    json["lines"] = sign.lines;
    json["capitals_px"] = sign_view.capitals;
    json["least_capitals_px"] = sign_view.least_capitals;
    faces["signs"].push_back(std::move(json));
  }
  return faces;
}

nlohmann::ordered_json poseJson(const geometry::Se3& pose) {
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Quaterniond& q = pose.rotation;
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

}  // namespace omnimapper::sim
