#include "CarriedLabels.h"

#include <omnimapper/building/RoomEdits.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/query/MapToAsk.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "PlaceLikeness.h"

namespace omnimapper::plugins {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Se2;

// The texts and places of signs whose text no other sign has.
std::map<std::string, Vector2d> signsIn(const map::Places& places) {
  std::vector<building::DoorSign> signs;
  for (const auto& place : places.places)
    if (place.kind == "sign" && !place.caption.empty() && !place.moved)
      signs.push_back({toString(place.id), place.caption, place.position.head<2>(), {}, false});
  return building::uniqueSigns(signs);
}

bool isLandmark(const map::Place& place) {
  return place.kind != map::Labels::kRegion && place.kind != map::Labels::kPlace;
}

// The place that has a label in its map: by the landmark's id, or by its name if the landmark was merged later.
const map::Place* placeOf(const map::Label& label, const map::Places& places) {
  const auto hasName = [&](const map::Place& place) {
    return std::any_of(place.properties.begin(), place.properties.end(), [&](const map::Property& property) {
      return property.name == "name" && textOf(property) == label.text;
    });
  };
  const map::Place* named = nullptr;
  for (const auto& place : places.places) {
    if (!isLandmark(place)) continue;
    if (place.id == *label.landmark) return &place;
    if (hasName(place)) named = &place;
  }
  return named;
}

// The only landmark of the new map that is like this one.
const map::Place* sameIn(const map::Places& now, const map::Place& place, std::string& why_not) {
  constexpr double kLeast = 0.4, kNearly = 0.8;
  const map::Place *best = nullptr, *other = nullptr;
  double most = 0, second = 0;
  for (const auto& each : now.places) {
    if (!isLandmark(each) || each.moved) continue;
    const double like = likenessOf(place, each);
    if (like > most) {
      second = most, other = best;
      most = like, best = &each;
    } else if (like > second) {
      second = like, other = &each;
    }
  }
  if (most < kLeast) {
    why_not = "nothing of its class and size is there";
    return nullptr;
  }
  if (second > kNearly * most) {
    why_not = "both " + toString(best->id) + " and " + toString(other->id) + " may be it";
    return nullptr;
  }
  return best;
}

// Anchors a point of the map to the nearest key frame.
bool anchorTo(const map::KeyFrames& key_frames, const Vector3d& point, double within, map::Label& label) {
  double least = within;
  bool is_found = false;
  for (const auto& frame : key_frames) {
    const auto frame_from_map = geometry::inverse(geometry::fromMrpt(frame.map_from_base));
    const Vector3d in_frame = frame_from_map * point;
    if (in_frame.head<2>().norm() > least) continue;
    least = in_frame.head<2>().norm();
    label.frame = frame.id;
    label.in_frame = in_frame;
    is_found = true;
  }
  return is_found;
}

Vector3d movedPoint(const Se2& motion, const Vector3d& point) {
  const Vector2d level = motion * point.head<2>();
  return {level.x(), level.y(), point.z()};
}

}  // namespace

LabelledMap readLabelledMap(const std::string& path) {
  const auto opened = query::openMap(path);
  LabelledMap map{{}, opened.places, opened.rooms};
  const auto file = map::MapFile::readOnly(opened.file, {map::Labels::kLayer});
  if (const auto* section = file.find(map::Labels::kLayer)) map.labels = map::Labels::fromSection(*section);
  return map;
}

std::optional<Se2> motionBetweenMaps(const LabelledMap& earlier, const LabelledMap& now) {
  if (!earlier.rooms || !now.rooms) return std::nullopt;
  const auto looks = building::anchoredTo({}, *earlier.rooms, signsIn(earlier.places));
  return building::alignEdits(looks, *now.rooms, signsIn(now.places));
}

CarriedLabels carryLabels(const LabelledMap& earlier, const LabelledMap& now, const Se2& now_from_earlier,
                          const map::KeyFrames& key_frames) {
  constexpr double kAnywhere = std::numeric_limits<double>::infinity(), kNear = 3;  // [m]
  CarriedLabels carried;
  std::set<base::LandmarkId> used;
  for (const map::Label& label : earlier.labels.labels) {
    map::Label fresh = label;
    std::string why_not;
    const map::Place* then = label.landmark ? placeOf(label, earlier.places) : nullptr;
    if (then) {
      if (const auto* same = sameIn(now.places, movedPlace(now_from_earlier, *then), why_not)) {
        fresh.landmark = same->id;
        anchorTo(key_frames, same->position, kAnywhere, fresh);
      }
    } else {
      // Labels of places are places of their own, each at one point.
      const auto point =
          std::find_if(earlier.places.places.begin(), earlier.places.places.end(), [&](const auto& each) {
            return each.kind == map::Labels::kPlace && each.label == label.text && used.count(each.id) == 0;
          });
      fresh.landmark.reset();
      if (point == earlier.places.places.end())
        why_not = "it has no place in the earlier map";
      else if (used.insert(point->id);
               !anchorTo(key_frames, movedPoint(now_from_earlier, point->position), kNear, fresh))
        why_not = "the robot has not been near";
    }
    if (why_not.empty()) carried.labels.push_back(fresh);
    carried.outcomes.push_back({label.text, why_not});
  }
  return carried;
}

}  // namespace omnimapper::plugins
