#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/geometry/centroid.h>
#include <omnimapper/map/LabelledPlaces.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <variant>

namespace omnimapper::map {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

void addPoints(const Extent& extent, std::vector<Vector2d>& points) {
  points.insert(points.end(), extent.points.begin(), extent.points.end());
  for (const auto& [from, to] : extent.lines) points.insert(points.end(), {from, to});
  for (const auto& outline : extent.outlines) points.insert(points.end(), outline.begin(), outline.end());
}

std::vector<Vector2d> pointsOf(const Place& place) {
  std::vector<Vector2d> points;
  addPoints(place.extent, points);
  if (points.empty()) points.push_back(place.position.head<2>());
  return points;
}

// Landmarks are numbered from 0 on, so the places that are none are numbered from the largest number down.
base::LandmarkId idOfNone(std::uint16_t session, std::size_t number) {
  return {session, std::numeric_limits<std::uint32_t>::max() - static_cast<std::uint32_t>(number)};
}

Place regionOf(const std::string& text, const std::vector<const Place*>& parts, std::size_t number) {
  Place region;
  region.id = idOfNone(parts.front()->id.session, number);
  region.kind = Labels::kRegion;
  region.label = text;
  region.extent.bottom = std::numeric_limits<double>::infinity();
  region.extent.top = -region.extent.bottom;
  region.first_seen = parts.front()->first_seen;
  std::vector<Vector2d> points;
  for (const Place* part : parts) {
    const auto of_part = pointsOf(*part);
    points.insert(points.end(), of_part.begin(), of_part.end());
    region.extent.bottom = std::min(region.extent.bottom, part->extent.bottom);
    region.extent.top = std::max(region.extent.top, part->extent.top);
    region.measurements += part->measurements;
    region.first_seen = std::min(region.first_seen, part->first_seen);
    region.last_seen = std::max(region.last_seen, part->last_seen);
  }
  const auto hull = geometry::convexHull(points);
  const auto centroid = geometry::centroid(hull);
  const Vector2d middle = centroid ? *centroid : hull.front();
  region.extent.outlines = {hull};
  region.position << middle, 0.5 * (region.extent.bottom + region.extent.top);
  return region;
}

Place pointOf(const Label& label, const Vector3d& at, std::size_t number) {
  Place place;
  place.id = idOfNone(label.frame.session, number);
  place.kind = Labels::kPlace;
  place.label = label.text;
  place.position = at;
  place.extent.points = {at.head<2>()};
  place.extent.bottom = place.extent.top = at.z();
  place.measurements = 1;
  place.first_seen = place.last_seen = label.when;
  return place;
}

bool isPart(base::LandmarkId id, const Place& place) {
  for (const auto& property : place.properties) {
    const auto* ids = std::get_if<std::string>(&property.value);
    if (property.name != kParts || !ids) continue;
    return (", " + *ids + ",").find(", " + toString(id) + ",") != std::string::npos;
  }
  return false;
}

}  // namespace

std::vector<Place>::iterator placeWithLandmark(std::vector<Place>& places, base::LandmarkId id) {
  return std::find_if(places.begin(), places.end(),
                      [&](const Place& place) { return place.id == id || isPart(id, place); });
}

void addLabels(const Labels& labels, const LabelAnchors& anchors, std::vector<Place>& places) {
  std::map<std::string, std::set<base::LandmarkId>> named;
  std::vector<Place> added;
  for (const Label& label : labels.labels) {
    const auto place = label.landmark ? placeWithLandmark(places, anchors.landmark(*label.landmark)) : places.end();
    if (place != places.end())
      named[label.text].insert(place->id);
    else
      added.push_back(pointOf(label, anchors.point(label), added.size()));
  }
  for (const auto& [text, landmarks] : named) {
    if (landmarks.size() == 1) {
      placeWithLandmark(places, *landmarks.begin())->properties.push_back({kName, text});
      continue;
    }
    std::vector<const Place*> parts;
    for (const auto id : landmarks) parts.push_back(&*placeWithLandmark(places, id));
    added.push_back(regionOf(text, parts, added.size()));
  }
  places.insert(places.end(), added.begin(), added.end());
}

void removeLabels(std::vector<Place>& places) {
  const auto isOfLabel = [](const Place& place) {
    return place.kind == Labels::kRegion || place.kind == Labels::kPlace;
  };
  places.erase(std::remove_if(places.begin(), places.end(), isOfLabel), places.end());
  for (Place& place : places) {
    auto& all = place.properties;
    all.erase(std::remove_if(all.begin(), all.end(), [](const Property& each) { return each.name == kName; }),
              all.end());
  }
}

}  // namespace omnimapper::map
