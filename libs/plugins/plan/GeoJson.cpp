#include "GeoJson.h"

#include <mrpt/system/datetime.h>
#include <omnimapper/derived/LevelFrame.h>
#include <omnimapper/derived/PlanShape.h>
#include <omnimapper/plugin/PlaceOnEarth.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

namespace omnimapper::plugins {

namespace {

using Json = nlohmann::ordered_json;

/// Converts positions to the coordinates of the file.
class Positions {
 public:
  explicit Positions(std::optional<mapper::EarthFrame> earth) : earth_(std::move(earth)) {}

  Json operator()(const derived::PlanPoint& point) const {
    if (!earth_) return {rounded(point.x(), kMillimetres), rounded(point.y(), kMillimetres)};
    const mapper::Geodetic place = (*earth_)({point.x(), point.y(), 0});
    return {rounded(place.longitude, kMillimetresInDegrees), rounded(place.latitude, kMillimetresInDegrees)};
  }

 private:
  static constexpr double kMillimetres = 1e3, kMillimetresInDegrees = 1e8;
  static double rounded(double value, double parts) { return std::round(value * parts) / parts + 0.0; }

  std::optional<mapper::EarthFrame> earth_;
};

std::string isoTime(base::Stamp stamp) {
  mrpt::system::TTimeParts parts;
  mrpt::system::timestampToParts(stamp, parts);
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d:%06.3fZ", parts.year, parts.month, parts.day, parts.hour,
                parts.minute, std::floor(parts.second * 1000) / 1000);
  return text;
}

// Measures and counts are numbers, so that a GIS can sort and style by them.
struct ValueJson {
  Json operator()(const std::string& text) const { return text; }
  Json operator()(std::uint64_t count) const { return count; }
  Json operator()(const map::Measure& measure) const {
    return std::isfinite(measure.value) ? Json(std::round(measure.value * 1000) / 1000 + 0.0) : Json();
  }
  Json operator()(bool flag) const { return flag; }
  Json operator()(base::Stamp stamp) const { return isoTime(stamp); }
};

// A path without the positions that rounding made equal to the one before.
Json walkOf(const std::vector<derived::PlanPoint>& points, const Positions& at) {
  Json walk = Json::array();
  for (const auto& point : points) {
    Json position = at(point);
    if (walk.empty() || walk.back() != position) walk.push_back(std::move(position));
  }
  return walk;
}

Json asGeometry(const char* type, Json coordinates) {
  return {{"type", type}, {"coordinates", std::move(coordinates)}};
}

// Adds a single geometry, or several of the same type as one Multi geometry.
void addParts(std::vector<Json>& geometries, const std::string& type, Json list) {
  if (list.size() == 1) geometries.push_back(asGeometry(type.c_str(), std::move(list.front())));
  if (list.size() > 1) geometries.push_back(asGeometry(("Multi" + type).c_str(), std::move(list)));
}

Json ringsOf(const derived::PlanShape& plan, const Positions& at) {
  Json polygons = Json::array();
  for (const auto& area : plan.areas) {
    Json ring = walkOf(area, at);
    if (!ring.empty() && ring.front() == ring.back()) ring.erase(ring.size() - 1);
    if (ring.size() < 3) continue;
    ring.push_back(Json(ring.front()));
    polygons.push_back(Json::array({std::move(ring)}));
  }
  return polygons;
}

/// Null if nothing of the shape is visible from above.
Json geometryOf(const map::LandmarkShape& shape, const Positions& at) {
  const derived::PlanShape plan = derived::fromAbove(shape);
  std::vector<Json> geometries;
  addParts(geometries, "Polygon", ringsOf(plan, at));
  Json lines = Json::array(), points = Json::array();
  for (const auto& [from, to] : plan.lines) {
    Json line = walkOf({from, to}, at);
    if (line.size() > 1) lines.push_back(std::move(line));
  }
  // A landmark that was in several places one after the other becomes a line through them.
  const bool has_track = shape.point_stamps.size() > 1;
  for (const auto& point : plan.points) points.push_back(at(point));
  if (has_track && plan.points.size() == shape.point_stamps.size()) {
    lines.push_back(std::move(points));
    points = Json::array();
  }
  addParts(geometries, "LineString", std::move(lines));
  addParts(geometries, "Point", std::move(points));
  if (geometries.empty()) return nullptr;
  if (geometries.size() == 1) return geometries.front();
  return {{"type", "GeometryCollection"}, {"geometries", geometries}};
}

Json propertiesOf(const derived::ShapedLandmark& shaped) {
  const map::Landmark& landmark = *shaped.landmark;
  Json properties = {{"feature", "landmark"}, {"label", shaped.shape.label}};
  if (!shaped.shape.caption.empty()) properties["caption"] = shaped.shape.caption;
  for (const auto& property : shaped.shape.properties)
    properties[map::keyOf(property)] = std::visit(ValueJson(), property.value);
  for (const auto& [label, count] : shaped.shape.seen_by) properties["seen_by_" + label] = count;
  if (const auto photograph = derived::photographAddress(shaped.shape); !photograph.empty())
    properties["photograph"] = photograph;
  properties["kind"] = landmark.kind;
  properties["state"] = shaped.moved ? "moved" : "present";
  properties["measurements"] = landmark.evidence;
  if (base::isValid(landmark.first_seen)) properties["first_seen"] = isoTime(landmark.first_seen);
  if (base::isValid(landmark.last_seen)) properties["last_seen"] = isoTime(landmark.last_seen);
  if (const Eigen::AlignedBox3d box = derived::boxOf(shaped.shape); !box.isEmpty()) {
    properties["bottom_m"] = std::round(box.min().z() * 1000) / 1000 + 0.0;
    properties["top_m"] = std::round(box.max().z() * 1000) / 1000 + 0.0;
  }
  if (!shaped.shape.point_stamps.empty()) {
    Json times = Json::array();
    for (const auto stamp : shaped.shape.point_stamps) times.push_back(isoTime(stamp));
    properties["times"] = std::move(times);
  }
  return properties;
}

// The trajectory of a session through its key frames.
Json trajectoryFeature(const map::Map& map, const map::Session& session, const Positions& at) {
  std::vector<derived::PlanPoint> path;
  base::Stamp first, last;
  for (const auto& frame : map.key_frames) {
    if (frame.id.session != session.number) continue;
    if (path.empty()) first = frame.stamp;
    last = frame.stamp;
    path.emplace_back(frame.map_from_base.x(), frame.map_from_base.y());
  }
  Json walk = walkOf(path, at);
  if (walk.size() < 2) return nullptr;
  return {{"type", "Feature"},
          {"id", "session " + std::to_string(session.number)},
          {"geometry", asGeometry("LineString", std::move(walk))},
          {"properties",
           {{"feature", "trajectory"},
            {"session", session.number},
            {"title", session.title},
            {"start", isoTime(first)},
            {"end", isoTime(last)}}}};
}

}  // namespace

std::string encodeGeoJson(const GeoJsonInput& input) {
  const auto place = input.metres ? nullptr : mapper::placeOnEarth(input.view);
  const Positions at(place ? std::optional(mapper::EarthFrame(*place, input.view)) : std::nullopt);
  Json features = Json::array();
  // With a place on the earth, x and y of the map are east and north, whatever the direction of its z.
  const derived::LevelFrame level(place ? map::Map() : input.view.map);
  for (const auto& shaped : level(derived::shapesOf(input.view))) {
    Json geometry = geometryOf(shaped.shape, at);
    if (geometry.is_null()) continue;
    features.push_back({{"type", "Feature"},
                        {"id", toString(shaped.landmark->id)},
                        {"geometry", std::move(geometry)},
                        {"properties", propertiesOf(shaped)}});
  }
  for (const auto& session : input.view.map.sessions) {
    if (!input.trajectory) break;
    Json trajectory = trajectoryFeature(level(input.view.map), session, at);
    if (!trajectory.is_null()) features.push_back(std::move(trajectory));
  }
  Json collection = {{"type", "FeatureCollection"}, {"name", input.title}};
  collection["frame"] = place ? "longitude and latitude, WGS84"
                        : level.isOfMap()
                            ? "x and y of the map in metres, place on the earth unknown"
                            : "x and y of the map, turned so that up is z, in metres, place on the earth unknown";
  collection["features"] = std::move(features);
  // Names from a log may not be valid UTF-8: invalid bytes are replaced.
  return collection.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace omnimapper::plugins
