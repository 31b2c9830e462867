#include "SessionBySigns.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/plugin/LandmarkShape.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "SignResection.h"

namespace omnimapper::plugins {

using Eigen::Vector3d;

namespace {

// The one sign of the earlier sessions that says this; none if there is none, or several.
std::optional<base::LandmarkId> oneWith(const SignText& text, const SignTracks& tracks, const mapper::View& view) {
  std::optional<base::LandmarkId> found;
  for (const auto& [id, known] : tracks.known()) {
    if (id.session == view.map.sessions.back().number) continue;
    const SignPayload& sign = signOf(view, id);
    if (agreementOf(text, sign.text()) != Agreement::agrees) continue;
    if (found || sign.is_repeated) return std::nullopt;
    found = id;
  }
  return found;
}

std::optional<SeenKnownSign> seenKnown(const SignSighting& sighting, base::LandmarkId sign, const map::KeyFrame& frame,
                                       const SignTracks& tracks, const mapper::View& view, double sigma) {
  const Vector3d place = view.graph.value(tracks.known().at(sign).variable);
  const auto normal = mapper::shapeOf(view.map.landmark(sign), view).normal;
  if (!normal) return std::nullopt;
  const double own = std::max(sighting.sigma_left, sighting.sigma_down);
  return SeenKnownSign{
      sign.index,    isOfOneSign(sighting.text), place, *normal, geometry::fromMrpt(frame.map_from_base),
      sighting.seen, std::hypot(own, sigma)};
}

// Before the sign, as far as signs are read from.
mapper::SessionPlace guessBefore(const SeenKnownSign& seen, const map::KeyFrame& frame) {
  constexpr double kPositionSigma = 2, kAngleSigma = 0.7;  // [m] [rad]
  return {frame.id, {geometry::toMrpt(baseBefore(seen, kReadingDistance)), kPositionSigma, kAngleSigma}};
}

}  // namespace

void SessionBySigns::learnState(const map::KeyFrame& frame, const SignTracks& tracks, const mapper::View& view,
                                double recent_travel) {
  constexpr double kLost = 3;  // [m]
  if (view.map.sessions.back().joined) {
    is_known_whether_lost_ = true;
    is_lost_ = false;
    placed_at_.reset();
    seen_.clear();
    return;
  }
  if (placed_at_ && tracks.travelled() - *placed_at_ > recent_travel) {  // nothing tied it to the map there
    placed_at_.reset();
    is_lost_ = true;
  }
  if (is_known_whether_lost_) return;
  const auto covariance = view.jointCovariance({frame.pose});
  if (!covariance) return;
  is_known_whether_lost_ = true;
  is_lost_ = std::sqrt(std::max((*covariance)(0, 0), (*covariance)(1, 1))) >= kLost;
}

std::optional<mapper::SessionPlace> SessionBySigns::fit(const map::KeyFrame& frame, const SignTracks& tracks,
                                                        const mapper::View& view, double sigma) const {
  std::vector<SeenKnownSign> sightings;
  for (const auto& seen : seen_) {
    if (tracks.known().count(seen.sign) == 0 || !view.map.key_frames.find(seen.frame)) continue;
    const auto known = seenKnown(seen.sighting, seen.sign, view.map.keyFrame(seen.frame), tracks, view, sigma);
    if (known) sightings.push_back(*known);
  }
  const auto fit = resection(sightings);
  if (!fit) return std::nullopt;
  return mapper::SessionPlace{frame.id,
                              {geometry::toMrpt(fit->map_from_session * geometry::fromMrpt(frame.map_from_base)),
                               fit->position_sigma, fit->angle_sigma}};
}

std::optional<SessionBySigns::Placement> SessionBySigns::take(const std::vector<SignSighting>& sightings,
                                                              const map::KeyFrame& frame, const SignTracks& tracks,
                                                              const mapper::View& view, double sigma,
                                                              double recent_travel) {
  constexpr std::size_t kMost = 20;
  learnState(frame, tracks, view, recent_travel);
  if (!is_lost_) return std::nullopt;
  std::optional<SeenKnownSign> newest;
  for (const auto& sighting : sightings) {
    const auto sign = oneWith(sighting.text, tracks, view);
    if (!sign) continue;
    const auto known = seenKnown(sighting, *sign, frame, tracks, view, sigma);
    if (!known) continue;
    if (known->is_numbered) newest = known;
    seen_.push_back({frame.id, sighting, *sign, tracks.travelled()});
  }
  while (!seen_.empty() && (seen_.size() > kMost || tracks.travelled() - seen_.front().travelled > recent_travel))
    seen_.pop_front();
  if (const auto place = fit(frame, tracks, view, sigma)) {
    is_lost_ = false;
    is_guessed_ = true;
    placed_at_ = tracks.travelled();
    seen_.clear();
    return Placement{*place, true, "signs are seen as from one place of the map: the session is moved there"};
  }
  if (is_guessed_ || !newest) return std::nullopt;
  is_guessed_ = true;
  return Placement{guessBefore(*newest, frame), false,
                   "a sign is read that the map has once: the session is moved before it, and waits for others that "
                   "agree"};
}

}  // namespace omnimapper::plugins
