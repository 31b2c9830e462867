#include "PlaceJson.h"

#include "PlaceText.h"

namespace omnimapper::query {

namespace {

template <class Point>
Json jsonOf(const Point& point) {
  Json list = Json::array();
  for (int i = 0; i < point.size(); ++i) list.push_back(point[i]);
  return list;
}

Json jsonOf(const std::vector<Eigen::Vector2d>& walk) {
  Json list = Json::array();
  for (const auto& point : walk) list.push_back(jsonOf(point));
  return list;
}

Json jsonOf(const std::vector<std::vector<Eigen::Vector2d>>& walks) {
  Json list = Json::array();
  for (const auto& walk : walks) list.push_back(jsonOf(walk));
  return list;
}

Json jsonOf(const std::optional<Eigen::Vector3d>& direction) {
  return direction ? jsonOf(*direction) : Json(nullptr);
}

Json jsonOf(const map::Extent& extent) {
  Json lines = Json::array();
  for (const auto& [from, to] : extent.lines) lines.push_back({jsonOf(from), jsonOf(to)});
  return {{"points", jsonOf(extent.points)}, {"lines", std::move(lines)}, {"outlines", jsonOf(extent.outlines)},
          {"holes", jsonOf(extent.holes)},   {"bottom_m", extent.bottom}, {"top_m", extent.top}};
}

struct ValueJson {
  Json operator()(const std::string& text) const { return text; }
  Json operator()(std::uint64_t count) const { return count; }
  Json operator()(const map::Measure& measure) const { return measure.value; }
  Json operator()(bool flag) const { return flag; }
  Json operator()(base::Stamp stamp) const { return timeJson(stamp); }
};

}  // namespace

Json timeJson(base::Stamp stamp) {
  std::string text = timeText(stamp);
  if (text.empty()) return nullptr;
  text[text.find(' ')] = 'T';
  return text + "Z";
}

Json jsonOf(const map::Place& place, bool brief) {
  if (brief)
    return {{"id", toString(place.id)},
            {"label", place.label},
            {"caption", place.caption},
            {"state", place.moved ? "moved" : "present"},
            {"position_m", jsonOf(place.position)}};
  Json properties = Json::object(), seen_by = Json::object();
  for (const auto& property : place.properties)
    properties[map::keyOf(property)] = std::visit(ValueJson(), property.value);
  for (const auto& [label, count] : place.seen_by) seen_by[label] = count;
  return {{"id", toString(place.id)},
          {"kind", place.kind},
          {"label", place.label},
          {"caption", place.caption},
          {"state", place.moved ? "moved" : "present"},
          {"position_m", jsonOf(place.position)},
          {"sigma_m", place.sigma ? Json(*place.sigma) : Json(nullptr)},
          {"sigma_is_along_normal", place.sigma_is_along_normal},
          {"extent", jsonOf(place.extent)},
          {"normal", jsonOf(place.normal)},
          {"seen_from", jsonOf(place.seen_from)},
          {"properties", std::move(properties)},
          {"measurements", place.measurements},
          {"seen_by", std::move(seen_by)},
          {"first_seen", timeJson(place.first_seen)},
          {"last_seen", timeJson(place.last_seen)}};
}

Json answerTo(const std::string& verb, const MapToAsk& map) {
  const auto& last = map.places.last_pose;
  return {{"verb", verb},
          {"map", map.file},
          {"map_id", map.id},
          {"frame", "map"},
          {"map_time", last ? timeJson(last->stamp) : Json(nullptr)}};
}

std::string textOf(const Json& document) {
  // Names from a map may not be valid UTF-8: invalid bytes are replaced.
  return document.dump(1, ' ', true, Json::error_handler_t::replace) + "\n";
}

}  // namespace omnimapper::query
