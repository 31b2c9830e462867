#include <omnimapper/eval/ObjectMapQuality.h>
#include <omnimapper/eval/Statistics.h>
#include <omnimapper/eval/TumFile.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "MeshDistance.h"

namespace omnimapper::eval {

namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr std::size_t kSample = 1000;  // most points of a model that are compared

// A mesh at one of its places.
struct Placed {
  std::size_t object;
  double from, until;  // [s] since the start of the log
  TriangleMesh mesh;   // in the true frame
  geometry::Se3 map_from_object;
  AlignedBox3d box;
};

TriangleMesh placedAt(const geometry::Se3& map_from_object, TriangleMesh mesh) {
  for (Vector3d& vertex : mesh.vertices) vertex = map_from_object * vertex;
  return mesh;
}

AlignedBox3d boxAround(const std::vector<Vector3d>& points) {
  AlignedBox3d box;
  for (const Vector3d& point : points) box.extend(point);
  return box;
}

// Every place at which an object stands until the end of the log.
std::vector<Placed> placesOf(const ObjectTruth& truth) {
  std::vector<Placed> placed;
  const double length = truth.end - truth.begin;
  for (std::size_t i = 0; i < truth.objects.size(); ++i) {
    const auto& places = truth.objects[i].places;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const TrueObjectPlace& place = places[k];
      if (place.in_motion || !place.map_from_object || (place.from > length && k > 0)) continue;
      const double until = k + 1 < places.size() ? places[k + 1].from : std::numeric_limits<double>::infinity();
      TriangleMesh mesh = placedAt(*place.map_from_object, truth.meshes[i]);
      const AlignedBox3d box = boxAround(mesh.vertices);
      placed.push_back({i, place.from, until, std::move(mesh), *place.map_from_object, box});
    }
  }
  return placed;
}

bool isThere(const Placed& place, const ObjectTruth& truth) {
  return place.until > truth.end - truth.begin;
}

std::vector<Vector3d> sampleOf(const std::vector<Vector3d>& points) {
  std::vector<Vector3d> sample;
  const std::size_t step = points.size() / kSample + 1;
  for (std::size_t i = 0; i < points.size(); i += step) sample.push_back(points[i]);
  return sample;
}

std::vector<double> distancesFrom(const TriangleMesh& mesh, const std::vector<Vector3d>& points, double margin) {
  const MeshDistance distance(mesh, boxAround(points), margin);
  std::vector<double> distances;
  std::transform(points.begin(), points.end(), std::back_inserter(distances), distance);
  std::sort(distances.begin(), distances.end());
  return distances;
}

// Of ascending values.
double atShare(const std::vector<double>& ascending, double share) {
  return ascending[static_cast<std::size_t>(share * static_cast<double>(ascending.size() - 1))];
}

// The mean over the object's axes of the share of its extent that the middle 96 % of the points cover.
double extentCovered(const std::vector<Vector3d>& points, const Placed& place, const TriangleMesh& own) {
  const AlignedBox3d whole = boxAround(own.vertices);
  const geometry::Se3 object_from_map = inverse(place.map_from_object);
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    for (const Vector3d& point : points)
      along.push_back(std::clamp((object_from_map * point)[axis], whole.min()[axis], whole.max()[axis]));
    std::sort(along.begin(), along.end());
    const double extent = whole.sizes()[axis];
    sum += extent > 0 ? (atShare(along, 0.98) - atShare(along, 0.02)) / extent : 1;
  }
  return sum / 3;
}

// Whether it is right that the object is present or gone, if the map had an occasion to know.
std::optional<bool> judgeState(const MappedObject& mapped, const Placed& place, const ObjectTruth& truth) {
  if (mapped.state == MappedObject::State::candidate) return {};
  const bool is_present = mapped.state == MappedObject::State::present;
  if (isThere(place, truth)) return is_present;
  const bool was_looked_for = mapped.last_looked && *mapped.last_looked > truth.begin + place.until;
  if (is_present && !was_looked_for) return {};
  return !is_present;
}

JudgedObject judge(const MappedObject& mapped, const std::vector<Placed>& places, const ObjectTruth& truth,
                   const ObjectMapOptions& options) {
  JudgedObject judged;
  const auto points = sampleOf(mapped.points);
  if (points.empty()) return judged;
  const AlignedBox3d box = boxAround(points);
  double best = 0;
  for (const Placed& place : places) {
    const AlignedBox3d around(place.box.min().array() - options.near, place.box.max().array() + options.near);
    if (!around.intersects(box)) continue;
    const auto distances = distancesFrom(place.mesh, points, std::numeric_limits<double>::infinity());
    const double share = shareWithin(distances, options.near);
    if (share < options.share || share < best) continue;  // of equal places the later one counts
    best = share;
    judged.is = JudgedObject::Is::object;
    judged.object = place.object;
    judged.is_there = isThere(place, truth);
    judged.state_is_right = judgeState(mapped, place, truth);
    const Vector3d middle = boxAround(truth.meshes[place.object].vertices).center();
    judged.position_error = (mapped.map_from_box.translation - place.map_from_object * middle).norm();
    judged.extent = extentCovered(points, place, truth.meshes[place.object]);
    judged.distance_median = atShare(distances, 0.5);
    judged.distance_90 = atShare(distances, 0.9);
  }
  if (judged.is == JudgedObject::Is::object) return judged;
  const auto distances = distancesFrom(truth.world, points, options.near);
  judged.is =
      shareWithin(distances, options.near) >= options.share ? JudgedObject::Is::furniture : JudgedObject::Is::nothing;
  return judged;
}

// The objects that were seen often enough at the place where they are at the end.
std::vector<SoughtObject> soughtObjects(const ObjectTruth& truth, const SeenLimits& limits) {
  std::vector<ObjectSighting> at_last_place;
  std::vector<bool> is_in_place;
  std::map<std::string, double> since;
  for (const TrueObject& object : truth.objects) {
    const TrueObjectPlace& last = object.at(truth.end - truth.begin);
    is_in_place.push_back(last.map_from_object && !last.in_motion);
    since[object.name] = truth.begin + last.from;
  }
  for (const ObjectSighting& sighting : truth.sightings) {
    const auto known = since.find(sighting.object);
    if (known == since.end() || base::unixSeconds(sighting.stamp) >= known->second) at_last_place.push_back(sighting);
  }
  std::vector<SoughtObject> sought;
  const auto seen = countSightings(truth.objects, at_last_place, limits);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i].is_seen && is_in_place[i]) sought.push_back({i, seen[i].images, {}});
  }
  return sought;
}

std::vector<ObjectCurvePoint> curveOf(const ObjectMap& map, const ObjectMapQuality& quality) {
  std::vector<ObjectCurvePoint> curve;
  std::set<int> steps{1};  // numbers of images at which the curve changes
  for (const MappedObject& object : map.objects)
    if (object.seen_in > 0) steps.insert(object.seen_in);
  if (map.objects.empty()) steps.clear();
  for (const int images : steps) {
    ObjectCurvePoint point;
    point.images = images;
    std::set<std::size_t> right;
    for (std::size_t i = 0; i < map.objects.size(); ++i) {
      const JudgedObject& judged = quality.judged[i];
      if (map.objects[i].state == MappedObject::State::gone || map.objects[i].seen_in < images) continue;
      ++point.objects;
      if (judged.is == JudgedObject::Is::object && judged.is_there) right.insert(judged.object);
    }
    const auto is_right = [&](const SoughtObject& sought) { return right.count(sought.object) > 0; };
    const auto recalled = std::count_if(quality.sought.begin(), quality.sought.end(), is_right);
    if (point.objects > 0) point.precision = static_cast<double>(right.size()) / static_cast<double>(point.objects);
    if (!quality.sought.empty())
      point.recall = static_cast<double>(recalled) / static_cast<double>(quality.sought.size());
    curve.push_back(point);
  }
  return curve;
}

}  // namespace

ObjectTruth readObjectTruth(const std::string& folder) {
  ObjectTruth truth;
  truth.objects = readTrueObjects(folder);
  for (const TrueObject& object : truth.objects) truth.meshes.push_back(readTriangleMesh(object.mesh));
  truth.sightings = readObjectSightings(folder);
  truth.world = readTriangleMesh(folder + "/world.ply");
  const Trajectory trajectory = readTrajectory(folder + "/truth.tum");
  truth.begin = base::unixSeconds(trajectory.front().stamp);
  truth.end = base::unixSeconds(trajectory.back().stamp);
  return truth;
}

std::size_t ObjectMapQuality::found() const {
  return static_cast<std::size_t>(
      std::count_if(sought.begin(), sought.end(), [](const SoughtObject& object) { return !object.by.empty(); }));
}

std::size_t ObjectMapQuality::doubled() const {
  return static_cast<std::size_t>(
      std::count_if(sought.begin(), sought.end(), [](const SoughtObject& object) { return object.by.size() > 1; }));
}

ObjectMapQuality judgeObjects(const ObjectMap& map, const ObjectTruth& truth, const ObjectMapOptions& options) {
  ObjectMapQuality quality;
  const auto places = placesOf(truth);
  for (const MappedObject& object : map.objects) quality.judged.push_back(judge(object, places, truth, options));
  quality.sought = soughtObjects(truth, options.seen);
  for (SoughtObject& sought : quality.sought) {
    for (std::size_t i = 0; i < map.objects.size(); ++i) {
      const JudgedObject& judged = quality.judged[i];
      if (map.objects[i].state == MappedObject::State::present && judged.is == JudgedObject::Is::object &&
          judged.is_there && judged.object == sought.object)
        sought.by.push_back(i);
    }
  }
  quality.curve = curveOf(map, quality);
  return quality;
}

}  // namespace omnimapper::eval
