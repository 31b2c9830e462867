#include "LabelledPlaces.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/geometry/centroid.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>

namespace omnimapper::derived {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

void addPoints(const map::Extent& extent, std::vector<Vector2d>& points) {
  points.insert(points.end(), extent.points.begin(), extent.points.end());
  for (const auto& [from, to] : extent.lines) points.insert(points.end(), {from, to});
  for (const auto& outline : extent.outlines) points.insert(points.end(), outline.begin(), outline.end());
}

// Landmarks are numbered from 0 on, so the places that are none are numbered from the largest number down.
base::LandmarkId idOfNone(std::uint16_t session, std::size_t number) {
  return {session, std::numeric_limits<std::uint32_t>::max() - static_cast<std::uint32_t>(number)};
}

map::Place regionOf(const std::string& text, const std::vector<const map::Place*>& parts, std::size_t number) {
  map::Place region;
  region.id = idOfNone(parts.front()->id.session, number);
  region.kind = map::Labels::kRegion;
  region.label = text;
  region.extent.bottom = std::numeric_limits<double>::infinity();
  region.extent.top = -region.extent.bottom;
  region.first_seen = parts.front()->first_seen;
  std::vector<Vector2d> points;
  for (const map::Place* part : parts) {
    addPoints(part->extent, points);
    region.extent.bottom = std::min(region.extent.bottom, part->extent.bottom);
    region.extent.top = std::max(region.extent.top, part->extent.top);
    region.measurements += part->measurements;
    region.first_seen = std::min(region.first_seen, part->first_seen);
    region.last_seen = std::max(region.last_seen, part->last_seen);
  }
  const auto hull = geometry::convexHull(points);
  const Vector2d middle = geometry::centroid(hull).value_or(hull.front());
  region.extent.outlines = {hull};
  region.position << middle, 0.5 * (region.extent.bottom + region.extent.top);
  return region;
}

map::Place pointOf(const map::Label& label, const map::Map& map, std::size_t number) {
  const Vector3d at = geometry::fromMrpt(map.keyFrame(label.frame).map_from_base) * label.in_frame;
  map::Place place;
  place.id = idOfNone(label.frame.session, number);
  place.kind = map::Labels::kPlace;
  place.label = label.text;
  place.position = at;
  place.extent.points = {at.head<2>()};
  place.extent.bottom = place.extent.top = at.z();
  place.measurements = 1;
  place.first_seen = place.last_seen = label.when;
  return place;
}

}  // namespace

void addLabels(const map::Map& map, std::vector<map::Place>& places) {
  const auto* labels = map.layers.find<map::Labels>();
  if (!labels) return;
  std::map<std::string, std::set<base::LandmarkId>> named;
  std::vector<map::Place> added;
  const auto placeOf = [&](base::LandmarkId id) {
    return std::find_if(places.begin(), places.end(), [&](const map::Place& place) { return place.id == id; });
  };
  for (const map::Label& label : labels->labels) {
    const auto id = label.landmark ? std::optional(map.landmark(*label.landmark).id) : std::nullopt;
    if (id && placeOf(*id) != places.end())
      named[label.text].insert(*id);
    else
      added.push_back(pointOf(label, map, added.size()));
  }
  for (const auto& [text, landmarks] : named) {
    if (landmarks.size() == 1) {
      placeOf(*landmarks.begin())->properties.push_back({"name", text});
      continue;
    }
    std::vector<const map::Place*> parts;
    for (const auto id : landmarks) parts.push_back(&*placeOf(id));
    added.push_back(regionOf(text, parts, added.size()));
  }
  places.insert(places.end(), added.begin(), added.end());
}

}  // namespace omnimapper::derived
