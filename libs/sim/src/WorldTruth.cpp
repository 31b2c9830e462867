#include "WorldTruth.h"

#include <nlohmann/json.hpp>

namespace omnimapper::sim {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Json toJson(const geometry::Se3& pose) {
  const auto& q = pose.rotation;
  return {{"position", toJson(pose.translation)}, {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

Json outlineInMap(const std::vector<Eigen::Vector3d>& outline_in_body, const geometry::Se3& map_from_body) {
  Json points = Json::array();
  for (const auto& point : outline_in_body) points.push_back(toJson(map_from_body * point));
  return points;
}

Json surfaceJson(const Surface& surface, const Body& body, int label) {
  Json json{{"label", label}, {"name", surface.name}, {"kind", toString(surface.kind)}, {"body", body.name}};
  if (surface.material.transmission > 0) json["transmission"] = surface.material.transmission;
  const auto map_from_body = body.track.at(0);
  if (!surface.face || !map_from_body) return json;
  const geometry::Plane3 plane = *map_from_body * surface.face->plane_in_body;
  json["normal"] = toJson(plane.normal);
  json["distance"] = plane.distance;
  json["outline"] = outlineInMap(surface.face->outline_in_body, *map_from_body);
  Json holes = Json::array();
  for (const auto& hole : surface.face->holes_in_body) holes.push_back(outlineInMap(hole, *map_from_body));
  json["holes"] = holes;
  return json;
}

Json surfacesJson(const World& world) {
  Json surfaces = Json::array();
  int label = 0;
  for (const Body& body : world.bodies) {
    for (const Surface& surface : body.surfaces) surfaces.push_back(surfaceJson(surface, body, ++label));
  }
  return surfaces;
}

Json placesJson(const Track& track) {
  Json places = Json::array();
  for (const Track::Place& place : track.places()) {
    Json json{{"from", place.time}};
    json["pose"] = place.map_from_body ? toJson(*place.map_from_body) : Json(nullptr);
    places.push_back(json);
  }
  return places;
}

const Body* findBody(const World& world, const std::string& name) {
  for (const Body& body : world.bodies) {
    if (body.name == name) return &body;
  }
  return nullptr;
}

Json roomsJson(const World& world) {
  Json rooms = Json::array();
  for (const Room& room : world.rooms) {
    Json outline = Json::array();
    for (const auto& point : room.outline) outline.push_back({point.x(), point.y()});
    rooms.push_back({{"name", room.name},
                     {"kind", room.kind},
                     {"number", room.number},
                     {"outline", outline},
                     {"floor", room.floor_z},
                     {"height", room.height}});
  }
  return rooms;
}

Json signsJson(const World& world) {
  Json signs = Json::array();
  for (const Sign& sign : world.signs) {
    signs.push_back({{"name", sign.name},
                     {"text", sign.lines},
                     {"room", sign.room},
                     {"width", sign.width},
                     {"height", sign.height},
                     {"capitals", sign.capitals},
                     {"pose", toJson(sign.map_from_sign)}});
  }
  return signs;
}

Json markersJson(const World& world) {
  Json markers = Json::array();
  for (const Marker& marker : world.markers) {
    const Body* body = findBody(world, marker.name);
    markers.push_back(
        {{"name", marker.name}, {"id", marker.id}, {"side", marker.side}, {"places", placesJson(body->track)}});
  }
  return markers;
}

Json pointsJson(const World& world) {
  Json points = Json::array();
  for (const PointLandmark& point : world.point_landmarks) {
    Json json{{"name", point.name}, {"id", point.id}};
    const Body* body = findBody(world, point.body);
    json["position"] = body ? Json(nullptr) : toJson(point.in_body);
    if (body) json["in_body"] = toJson(point.in_body), json["places"] = placesJson(body->track);
    points.push_back(json);
  }
  return points;
}

Json objectsJson(const World& world) {
  Json objects = Json::array();
  for (const Object& object : world.objects) {
    const Body* body = findBody(world, object.name);
    objects.push_back({{"name", object.name},
                       {"shape", object.shape},
                       {"moveable", object.moveable},
                       {"moved", !body->track.isFixed()},
                       {"places", placesJson(body->track)}});
    // Between two places of a motion the object goes straight from one to the other; otherwise it stays until the next.
    if (body->track.kind() == Track::Kind::motion) objects.back()["motion"] = true;
  }
  return objects;
}

Json peopleJson(const World& world) {
  Json people = Json::array();
  for (const Person& person : world.people) {
    Json acts = Json::array();
    for (const auto& act : person.pointing) {
      acts.push_back({{"begin", act.begin},
                      {"end", act.end},
                      {"target", act.target},
                      {"target_position", toJson(act.target_in_map)},
                      {"arm", act.right_arm ? "right" : "left"}});
    }
    people.push_back({{"name", person.name}, {"bodies", person.bodies}, {"pointing", acts}});
  }
  return people;
}

}  // namespace

std::string landmarksJson(const Simulation& simulation) {
  const World& world = simulation.world();
  const Json json{{"frame", "map, z up; metres; times in seconds since the start; outlines of surfaces at time 0"},
                  {"start", simulation.options().start},
                  {"duration", simulation.duration()},
                  {"rooms", roomsJson(world)},
                  {"signs", signsJson(world)},
                  {"markers", markersJson(world)},
                  {"points", pointsJson(world)},
                  {"objects", objectsJson(world)},
                  {"people", peopleJson(world)},
                  {"surfaces", surfacesJson(world)}};
  return json.dump(1) + "\n";
}

}  // namespace omnimapper::sim
