#include "SessionByPlanes.h"

#include <omnimapper/geometry/Conversions.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace omnimapper::plugins {

using Eigen::Vector3d;
using geometry::Se3;

bool RecentSurfaces::add(const map::KeyFrame& frame, const std::vector<PlaneMeasurement>& measurements,
                         const Vector3d& sensor_in_base) {
  const auto samples = samplesOf(measurements, sensor_in_base);
  if (samples.empty()) return false;
  if (seen_.empty() || seen_.back().frame != frame.id) seen_.push_back({frame.id, {}});
  auto& all = seen_.back().in_base;
  all.insert(all.end(), samples.begin(), samples.end());
  sensor_in_base_ = sensor_in_base;
  return true;
}

void RecentSurfaces::keep(std::size_t key_frames) {
  while (seen_.size() > key_frames) seen_.pop_front();
}

std::vector<SurfaceSample> RecentSurfaces::inSession(const map::Map& map, std::size_t first, std::size_t end) const {
  constexpr double kPlace = 0.25, kFarthest = 1e6;  // [m]
  std::vector<SurfaceSample> samples;
  std::set<std::array<int, 6>> places;
  for (std::size_t i = end; i-- > first;) {
    const auto* frame = map.key_frames.find(seen_[i].frame);
    if (!frame) continue;
    const Se3 pose = geometry::fromMrpt(frame->map_from_base);
    for (const auto& sample : seen_[i].in_base) {
      const SurfaceSample moved = pose * sample;
      if (!(moved.point.cwiseAbs().maxCoeff() < kFarthest)) continue;
      std::array<int, 6> place{};
      for (int axis = 0; axis < 3; ++axis) {
        place[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(moved.point[axis] / kPlace));
        place[static_cast<std::size_t>(axis + 3)] = static_cast<int>(std::lround(moved.normal[axis]));
      }
      if (places.insert(place).second) samples.push_back(moved);
    }
  }
  return samples;
}

std::optional<std::size_t> RecentSurfaces::secondView(const map::Map& map) const {
  constexpr double kApart = 1, kTurned = 0.8;  // [m] [rad]
  if (seen_.size() < 2) return std::nullopt;
  const auto poseOf = [&](std::size_t i) -> std::optional<Se3> {
    const auto* frame = map.key_frames.find(seen_[i].frame);
    return frame ? std::optional(geometry::fromMrpt(frame->map_from_base)) : std::nullopt;
  };
  const auto last = poseOf(seen_.size() - 1);
  for (std::size_t i = seen_.size() - 1; last && i-- > 0;) {
    const auto pose = poseOf(i);
    if (!pose) continue;
    const auto motion = geometry::minus(*pose, *last);
    if (motion.head<3>().norm() >= kApart || motion.tail<3>().norm() >= kTurned) return i + 1;
  }
  return std::nullopt;
}

namespace {

using SeenTriple = std::array<const SeenPlane*, 3>;
using MapTriple = std::array<const KnownSurfaces::Part*, 3>;

// Triples that hold a pose in each direction, those of large planes first.
std::vector<SeenTriple> triplesOf(const std::vector<SeenPlane>& planes) {
  constexpr std::size_t kLargest = 8, kMost = 12;
  constexpr double kLeastArea = 0.4, kIndependent = 0.4;  // [m^2], determinant of the normals
  std::vector<SeenTriple> triples;
  const std::size_t count = std::min(kLargest, planes.size());
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b)
      for (std::size_t c = b + 1; c < count && planes[c].area >= kLeastArea; ++c)
        if (std::abs(planes[a].normal.cross(planes[b].normal).dot(planes[c].normal)) > kIndependent)
          triples.push_back({&planes[a], &planes[b], &planes[c]});
  std::stable_sort(triples.begin(), triples.end(),
                   [](const SeenTriple& one, const SeenTriple& other) { return one[2]->area > other[2]->area; });
  if (triples.size() > kMost) triples.resize(kMost);
  return triples;
}

// The pose at which three planes of a session lie on three of the map.
Se3 poseOf(const SeenTriple& seen, const MapTriple& known) {
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero(), normals;
  for (std::size_t i = 0; i < 3; ++i) {
    correlation += known[i]->plane.normal * seen[i]->normal.transpose();
    normals.row(static_cast<Eigen::Index>(i)) = known[i]->plane.normal.transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d rotation = svd.matrixU() * svd.matrixV().transpose();
  if (rotation.determinant() < 0) {
    Eigen::Matrix3d u = svd.matrixU();
    u.col(2) = -u.col(2);
    rotation = u * svd.matrixV().transpose();
  }
  Vector3d distances;
  for (std::size_t i = 0; i < 3; ++i)
    distances[static_cast<Eigen::Index>(i)] = -signedDistance(known[i]->plane, rotation * seen[i]->middle);
  return {Eigen::Quaterniond(rotation), normals.partialPivLu().solve(distances)};
}

// Area of the triple's planes that lies on the three surfaces of the map [m^2]; 0 if a plane hardly does.
double overlapOf(const SeenTriple& seen, const MapTriple& known, const Se3& pose) {
  constexpr double kLeastShare = 0.3;
  double area = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto on = std::count_if(seen[i]->points.begin(), seen[i]->points.end(),
                                  [&](const Vector3d& point) { return known[i]->wasSeenNear(pose * point); });
    const double share = static_cast<double>(on) / static_cast<double>(seen[i]->points.size());
    if (share < kLeastShare) return 0;
    area += share * seen[i]->area;
  }
  return area;
}

struct Hypothesis {
  Se3 pose;
  double score;  // [m^2]
};

void keepBest(std::vector<Hypothesis>& all, std::size_t count) {
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  if (all.size() > count) all.resize(count);
}

bool areOnePlace(const Se3& a, const Se3& b, const Vector3d& middle) {
  constexpr double kApart = 0.3, kTurned = 0.17;  // [m] [rad]
  return (a * middle - b * middle).norm() < kApart && geometry::minus(a, b).tail<3>().norm() < kTurned;
}

bool isLevelMotion(const Se3& pose) {
  constexpr double kTilt = 0.1, kHeight = 0.3;  // [rad] [m]
  return (pose.rotation * Vector3d::UnitZ()).head<2>().norm() < kTilt && std::abs(pose.translation.z()) < kHeight;
}

// Whether one place is better than another by far: it explains much more, or it leaves out only little of what the
// other one leaves out, as where a room looks nearly the same from the other end. `all`: area that is compared [m^2].
bool isDistinct(const Hypothesis& best, const Hypothesis& other, double all) {
  constexpr double kShare = 0.6, kTimes = 3, kLeast = 1;  // of the score; of what is left out, and [m^2] beyond
  return other.score <= kShare * best.score || all - other.score >= kTimes * (all - best.score) + kLeast;
}

// Poses at which three planes of the session lie on three surfaces of the map.
std::vector<Hypothesis> hypothesesOf(const std::vector<SeenPlane>& planes, const KnownSurfaces& map, bool planar) {
  constexpr std::size_t kLargest = 100, kKept = 400;
  constexpr double kLeastArea = 0.3, kAngle = 0.12;  // [m^2], of cosines
  std::vector<const KnownSurfaces::Part*> surfaces;
  for (const auto& part : map.all())
    if (part.area >= kLeastArea) surfaces.push_back(&part);
  std::stable_sort(surfaces.begin(), surfaces.end(), [](const auto* a, const auto* b) { return a->area > b->area; });
  if (surfaces.size() > kLargest) surfaces.resize(kLargest);
  std::vector<Hypothesis> found;
  for (const auto& seen : triplesOf(planes)) {
    const auto isAlike = [&](const auto* one, const auto* other, std::size_t i, std::size_t j) {
      return std::abs(one->plane.normal.dot(other->plane.normal) - seen[i]->normal.dot(seen[j]->normal)) < kAngle;
    };
    const double handed = seen[0]->normal.cross(seen[1]->normal).dot(seen[2]->normal);
    for (const auto* first : surfaces)
      for (const auto* second : surfaces) {
        if (!isAlike(first, second, 0, 1)) continue;
        const Vector3d cross = first->plane.normal.cross(second->plane.normal);
        for (const auto* third : surfaces) {
          if (!isAlike(first, third, 0, 2) || !isAlike(second, third, 1, 2)) continue;
          if (cross.dot(third->plane.normal) * handed <= 0) continue;
          Se3 pose = poseOf(seen, {first, second, third});
          if (planar && !isLevelMotion(pose)) continue;
          if (planar) pose = geometry::lift(geometry::project(pose));
          const double overlap = overlapOf(seen, {first, second, third}, pose);
          if (overlap > 0) found.push_back({pose, overlap});
        }
      }
    if (found.size() > 20 * kKept) keepBest(found, kKept);
  }
  keepBest(found, kKept);
  return found;
}

}  // namespace

std::optional<SessionPlacing> placeOf(const std::vector<SurfaceSample>& in_session, const KnownSurfaces& map,
                                      bool planar) {
  constexpr std::size_t kRefined = 60, kThinned = 150;
  constexpr double kContradictionCosts = 2;
  Vector3d middle = Vector3d::Zero();
  for (const auto& sample : in_session) middle += sample.sensor / static_cast<double>(in_session.size());
  std::vector<SurfaceSample> thinned;
  const std::size_t every = std::max<std::size_t>(1, in_session.size() / kThinned);
  for (std::size_t i = 0; i < in_session.size(); i += every) thinned.push_back(in_session[i]);

  auto found = hypothesesOf(seenPlanesOf(in_session), map, planar);
  for (auto& one : found) {
    double agrees = 0;
    for (const auto& sample : thinned)
      if (map.under(one.pose * sample)) agrees += sample.area;
    one.score = agrees;
  }
  keepBest(found, found.size());
  std::vector<Hypothesis> places;
  for (const auto& one : found) {
    if (places.size() >= kRefined) break;
    const Se3 pose = map.settled(thinned, one.pose, planar);
    if (std::any_of(places.begin(), places.end(),
                    [&](const auto& place) { return areOnePlace(place.pose, pose, middle); }))
      continue;
    const auto agreement = map.compare(in_session, pose);
    places.push_back({pose, agreement.agrees - kContradictionCosts * agreement.contradicts});
  }
  keepBest(places, places.size());
  if (places.empty() || !(places[0].score > 0)) return std::nullopt;
  const Se3 pose = map.settled(in_session, places[0].pose, planar);
  const auto agreement = map.compare(in_session, pose);
  return SessionPlacing{pose, agreement, places.size() < 2 || isDistinct(places[0], places[1], agreement.all)};
}

std::optional<mapper::SessionPlace> SessionByPlanes::take(const map::KeyFrame& frame, const RecentSurfaces& recent,
                                                          const PlaneLandmarkIndex& known, const mapper::View& view,
                                                          bool planar, bool is_free) {
  constexpr double kLost = 3;                                 // [m]
  constexpr std::size_t kSpacing = 5, kPatience = 30;         // [key frames]
  constexpr double kShare = 0.97, kLeastSeen = 0.4;           // of what is compared with the map, of what is seen
  constexpr double kHeld = 0.5;                               // [m^2] in each direction
  constexpr double kPositionSigma = 0.1, kAngleSigma = 0.05;  // [m] [rad]
  const auto covariance = view.jointCovariance({frame.pose});
  const bool is_uncertain = covariance && std::max((*covariance)(0, 0), (*covariance)(1, 1)) >= kLost * kLost;
  if (!is_known_whether_lost_ && covariance) {
    is_known_whether_lost_ = true;
    is_lost_ = is_uncertain;
  }
  is_unsolved_ = since_placed_ > 0 && is_uncertain;
  if (!is_lost_ && since_placed_ > 0 && since_placed_++ > kPatience) {  // nothing has tied it since
    is_lost_ = true;
    since_placed_ = 0;
  }
  if (!is_lost_ || !is_free || ++since_search_ < kSpacing + searches_ / 2) return std::nullopt;
  const auto second = recent.secondView(view.map);
  if (!second) return std::nullopt;
  since_search_ = 0;
  ++searches_;  // they become rarer, because a session of another place is never found
  const KnownSurfaces map(known, view.map.sessions.back().number, view.map.key_frames, recent.sensorInBase());
  const auto placing = placeOf(recent.inSession(view.map), map, planar);
  found_ = "the planes that are seen fit no place of the map";
  if (!placing) return std::nullopt;
  const auto fits = [&](const SurfaceAgreement& agreement) {
    return agreement.share() >= kShare && agreement.agrees >= kLeastSeen * agreement.all &&
           agreement.heldAtLeast(planar) >= kHeld;
  };
  const auto& pose = placing->map_from_session;
  found_ = "the planes that are seen fit more than one place of the map";
  if (!placing->is_distinct) return std::nullopt;
  found_ = "the planes that are seen fit a place of the map too poorly";
  if (!fits(placing->agreement)) return std::nullopt;
  for (const auto& view_of_it :
       {recent.inSession(view.map, 0, *second), recent.inSession(view.map, *second, recent.size())})
    if (!fits(map.compare(view_of_it, pose))) return std::nullopt;
  found_ = "the planes of two views fit one place of the map: the session is moved there";
  is_lost_ = false;
  searches_ = 0;
  since_placed_ = 1;
  const auto map_from_base = geometry::toMrpt(pose * geometry::fromMrpt(frame.map_from_base));
  return mapper::SessionPlace{frame.id, {map_from_base, kPositionSigma, kAngleSigma}};
}

void PlaneWatch::add(const RecentSurfaces& recent, const PlaneLandmarkIndex& known, const mapper::View& view,
                     bool planar) {
  constexpr std::size_t kCompared = 5, kEvery = 3;                                  // [key frames] [calls]
  constexpr double kContradicts = 0.3, kConfirms = 0.95, kSeen = 0.4, kHeld = 0.3;  // shares, [m^2]
  if (calls_++ % kEvery != 0) return;                                               // the cost grows with the map
  const KnownSurfaces map(known, view.map.sessions.back().number, view.map.key_frames, recent.sensorInBase());
  const std::size_t first = recent.size() - std::min(recent.size(), kCompared);
  const auto agreement = map.compare(recent.inSession(view.map, first, recent.size()), {});
  const bool contradicts = agreement.contradicts > 0 && 1 - agreement.share() > kContradicts;
  ++compared_;
  contradicted_ += contradicts;
  contradicting_ = contradicts ? contradicting_ + 1 : 0;
  if (agreement.share() >= kConfirms && agreement.agrees >= kSeen * agreement.all &&
      agreement.heldAtLeast(planar) >= kHeld)
    since_confirmed_ = 0;
}

std::optional<mapper::Evidence> PlaneWatch::evidence() const {
  constexpr double kMuch = 20;  // [%]
  if (compared_ == 0) return std::nullopt;
  const double percent = 100 * static_cast<double>(contradicted_) / static_cast<double>(compared_);
  mapper::Evidence evidence{"session_views_contradicting_percent", percent, mapper::Evidence::Says::good, ""};
  if (percent <= kMuch) return evidence;
  evidence.says = mapper::Evidence::Says::against_it;
  evidence.reason =
      "planes that the newest session sees contradict those of the earlier sessions: it may be aligned to a "
      "wrong place that looks similar";
  return evidence;
}

}  // namespace omnimapper::plugins
