#include "SignPlacement.h"

#include <omnimapper/geometry/Conversions.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

using Eigen::Vector3d;

namespace {

using KnownSign = std::map<base::LandmarkId, SignTracks::Known>::value_type;

bool isOfNewest(base::LandmarkId id, const mapper::View& view) {
  return id.session == view.map.sessions.back().number;
}

// The one sign of the earlier sessions with this number; null if there is none, or several.
const KnownSign* oneWith(const SignText& text, const SignTracks& tracks, const mapper::View& view) {
  const KnownSign* found = nullptr;
  if (!isOfOneSign(text)) return found;
  for (const auto& known : tracks.known()) {
    if (isOfNewest(known.first, view)) continue;
    const SignPayload& sign = signOf(view, known.first);
    if (sign.text().number != text.number) continue;
    if (found || sign.is_repeated) return nullptr;
    found = &known;
  }
  return found;
}

Vector3d placeOf(const SignTracks::Known& known, const mapper::View& view) {
  return view.graph.value(known.variable);
}

}  // namespace

std::optional<mapper::SessionPlace> SignPlacement::byOneSighting(const std::vector<SignSighting>& sightings,
                                                                 const map::KeyFrame& frame, const SignTracks& tracks,
                                                                 const mapper::View& view) {
  constexpr double kPositionSigma = 2, kAngleSigma = 0.7;  // [m] [rad]
  for (const auto& sighting : sightings) {
    const KnownSign* known = oneWith(sighting.text, tracks, view);
    if (!known) continue;
    const Vector3d sign = placeOf(known->second, view);
    const auto shape = signOf(view, known->first).shape({sign}, view.map.key_frames);
    if (!shape.normal) continue;
    const Vector3d& seen = sighting.seen.direction();
    const double yaw = std::atan2(-shape.normal->y(), -shape.normal->x()) - std::atan2(seen.y(), seen.x());
    const Eigen::AngleAxisd turn(yaw, Vector3d::UnitZ());
    const Vector3d camera = sign + kReadingDistance * *shape.normal;
    Vector3d base = camera - turn * sighting.seen.camera();
    base.z() = frame.map_from_base.z();
    return mapper::SessionPlace{
        frame.id, {geometry::toMrpt(geometry::Se3{Eigen::Quaterniond(turn), base}), kPositionSigma, kAngleSigma}};
  }
  return std::nullopt;
}

std::optional<mapper::SessionPlace> SignPlacement::byTwoSigns(const SignTracks& tracks, const mapper::View& view) {
  constexpr double kNearest = 1.5, kMostApart = 0.4, kSameHeight = 0.3;  // [m]
  struct Pair {
    Vector3d in_session, in_map;
  };
  std::vector<Pair> pairs;
  for (const auto& [id, known] : tracks.known()) {
    if (!isOfNewest(id, view)) continue;
    if (const KnownSign* old = oneWith(signOf(view, id).text(), tracks, view))
      pairs.push_back({placeOf(known, view), placeOf(old->second, view)});
  }
  const Pair *first = nullptr, *second = nullptr;
  double farthest = kNearest;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Vector3d a = pairs[i].in_session - pairs[k].in_session, b = pairs[i].in_map - pairs[k].in_map;
      const double level = a.head<2>().norm();
      const bool fits = std::abs(level - b.head<2>().norm()) < kMostApart && std::abs(a.z() - b.z()) < kSameHeight;
      if (level < farthest || !fits) continue;
      farthest = level;
      first = &pairs[k];
      second = &pairs[i];
    }
  }
  if (!first) return std::nullopt;
  const Vector3d there = second->in_map - first->in_map, here = second->in_session - first->in_session;
  const Eigen::AngleAxisd turn(std::atan2(there.y(), there.x()) - std::atan2(here.y(), here.x()), Vector3d::UnitZ());
  Vector3d shift = 0.5 * (first->in_map + second->in_map) - turn * (0.5 * (first->in_session + second->in_session));
  shift.z() = 0;
  const geometry::Se3 map_from_session{Eigen::Quaterniond(turn), shift};
  const auto& frame = view.map.key_frames.back();
  return mapper::SessionPlace{frame.id,
                              {geometry::toMrpt(map_from_session * geometry::fromMrpt(frame.map_from_base)),
                               0.5 * kMostApart, kMostApart / farthest}};
}

}  // namespace omnimapper::plugins
