#include <omnimapper/derived/LevelFrame.h>
#include <omnimapper/derived/ThingsOfMap.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace omnimapper::derived {

namespace {

void addText(const map::Property& property, std::vector<map::Property>& properties) {
  const auto* text = std::get_if<std::string>(&property.value);
  if (!text) return;
  const bool is_known = std::any_of(properties.begin(), properties.end(), [&](const map::Property& known) {
    return known.name == property.name && std::get<std::string>(known.value) == *text;
  });
  if (!is_known) properties.push_back(property);
}

/// The place of a thing, whose faces have these places, in the order of ids.
map::Place placeOf(const surfaces::Thing& thing, const std::vector<const map::Place*>& faces) {
  map::Place place;
  place.id = faces.front()->id;
  place.kind = place.label = toString(thing.is);
  place.position << thing.middle, (thing.bottom + thing.top) / 2;
  place.extent.outlines = {thing.corners()};
  place.extent.bottom = thing.bottom;
  place.extent.top = thing.top;
  place.first_seen = faces.front()->first_seen;
  std::string parts;
  for (const map::Place* face : faces) {
    place.measurements += face->measurements;
    for (const auto& [label, count] : face->seen_by) place.seen_by[label] += count;
    place.first_seen = std::min(place.first_seen, face->first_seen);
    place.last_seen = std::max(place.last_seen, face->last_seen);
    if (place.caption.empty()) place.caption = face->caption;
    for (const auto& property : face->properties) addText(property, place.properties);
    parts += (parts.empty() ? "" : ", ") + toString(face->id);
  }
  const double degrees = thing.direction * 180 / M_PI;
  place.properties.push_back({map::kParts, parts});
  place.properties.push_back({"length", map::Measure{thing.length, "m"}});
  place.properties.push_back({"width", map::Measure{thing.width, "m"}});
  place.properties.push_back({"height", map::Measure{thing.top - thing.bottom, "m"}});
  place.properties.push_back({"direction", map::Measure{degrees, "deg"}});
  return place;
}

}  // namespace

surfaces::Surface surfaceOf(const ShapedLandmark& shaped) {
  const map::LandmarkShape& shape = shaped.shape;
  surfaces::Surface surface;
  surface.name = toString(shaped.landmark->id);
  surface.is = surfaces::surfaceClassNamed(shape.label).value_or(surfaces::SurfaceClass::surface);
  surface.reason = shape.reason;
  surface.is_candidate = shape.is_candidate;
  surface.measurements = static_cast<int>(shaped.landmark->evidence);
  surface.plane = planeOf(shape.surfaces.front(), shape);
  for (std::size_t i = 0; i < shape.surfaces.size(); ++i) {
    const auto walks = withHoles(i, shape);
    surfaces::FlatPart& part = surface.parts.emplace_back();
    part.outline = walks.front().vertices;
    for (std::size_t hole = 1; hole < walks.size(); ++hole) part.holes.push_back(walks[hole].vertices);
  }
  return surface;
}

std::vector<surfaces::Thing> thingsOf(const std::vector<ShapedLandmark>& landmarks, const map::Map& map) {
  if (!LevelFrame(map).isOfMap()) return {};
  std::vector<surfaces::Surface> all;
  for (const auto& shaped : landmarks) {
    const bool is_face = !shaped.moved && !shaped.shape.surfaces.empty() && !shaped.shape.is_candidate;
    all.push_back(is_face ? surfaceOf(shaped) : surfaces::Surface());
  }
  return surfaces::thingsOf(all);
}

void joinFaces(const std::vector<surfaces::Thing>& things, const std::vector<ShapedLandmark>& landmarks,
               std::vector<map::Place>& places) {
  std::set<base::LandmarkId> joined;
  std::vector<map::Place> added;
  for (const auto& thing : things) {
    std::set<base::LandmarkId> ids;
    for (const std::size_t face : thing.faces) ids.insert(landmarks[face].landmark->id);
    std::vector<const map::Place*> faces;
    for (const auto& place : places)
      if (ids.count(place.id) > 0) faces.push_back(&place);
    if (faces.size() < 2) continue;
    added.push_back(placeOf(thing, faces));
    joined.insert(ids.begin(), ids.end());
  }
  const auto is_joined = [&](const map::Place& place) { return joined.count(place.id) > 0; };
  places.erase(std::remove_if(places.begin(), places.end(), is_joined), places.end());
  places.insert(places.end(), added.begin(), added.end());
  std::stable_sort(places.begin(), places.end(), [](const map::Place& a, const map::Place& b) { return a.id < b.id; });
}

}  // namespace omnimapper::derived
