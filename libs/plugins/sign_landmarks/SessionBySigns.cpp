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

// The only sign of the earlier sessions with this text; none if there is no such sign, or more than one.
std::optional<base::LandmarkId> oneWith(const SignText& text, const SignTracks& tracks, const mapper::View& view) {
  std::optional<base::LandmarkId> found;
  const auto first = view.map.sessions.front().number;
  for (const auto& [id, known] : tracks.all()) {
    if (id.session == view.map.sessions.back().number || !view.areAligned(id.session, first)) continue;
    const SignPayload& sign = signOf(view, id);
    if (agreementOf(text, sign.text()) != Agreement::agrees) continue;
    if (found || sign.is_repeated) return std::nullopt;
    found = id;
  }
  return found;
}

// Standard deviation of a sign's position in the least certain axis [m]; 0 for a fixed one.
double sigmaOf(base::VariableId variable, const mapper::View& view) {
  const auto covariance = view.jointCovariance({variable});
  return covariance && covariance->allFinite() ? std::sqrt(covariance->diagonal().maxCoeff()) : 0;
}

// None if the position of the sign is too uncertain, or its normal is unknown.
std::optional<KnownSignBearing> seenKnown(const SignMeasurement& measurement, base::LandmarkId sign,
                                          const map::KeyFrame& frame, const SignTracks& tracks,
                                          const mapper::View& view, const KnownOffsets& offsets) {
  constexpr double kUncertain = 0.5;  // [m]
  const auto variable = tracks.all().at(sign).variable;
  const auto normal = mapper::shapeOf(view.map.landmark(sign), view).normal;
  const double sign_sigma = sigmaOf(variable, view);
  if (!normal || !(sign_sigma < kUncertain)) return std::nullopt;
  const double own = std::max(measurement.sigma_left, measurement.sigma_down);
  const Vector3d direction = turnedBy(offsets.pan_tilt, measurement.tilt_axis, measurement.seen.direction());
  return KnownSignBearing{sign,
                          isOfOneSign(measurement.text),
                          view.graph.value(variable),
                          *normal,
                          geometry::fromMrpt(frame.map_from_base),
                          MeasuredDirection(measurement.seen.camera(), direction),
                          std::hypot(own, std::hypot(offsets.sigma, sign_sigma / kReadingDistance))};
}

// A place in front of the sign, at the typical reading distance. The tilt of the base is kept.
mapper::SessionPlace guessBefore(const KnownSignBearing& seen, const map::KeyFrame& frame) {
  constexpr double kPositionSigma = 2, kAngleSigma = 0.7;  // [m] [rad]
  const auto before = baseBefore(seen, kReadingDistance);
  const Vector3d ahead = before.rotation * Vector3d::UnitX(), now = seen.session_from_base.rotation * Vector3d::UnitX();
  const double turn = std::atan2(ahead.y(), ahead.x()) - std::atan2(now.y(), now.x());
  const Eigen::Quaterniond rotation = Eigen::AngleAxisd(turn, Vector3d::UnitZ()) * seen.session_from_base.rotation;
  return {frame.id, {geometry::toMrpt(geometry::Se3{rotation, before.translation}), kPositionSigma, kAngleSigma}};
}

}  // namespace

void SessionBySigns::learnState(const map::KeyFrame& frame, const SignTracks& tracks, const mapper::View& view,
                                double recent_travel) {
  constexpr double kLost = 3;                                            // [m]
  if (placed_at_ && tracks.travelled() - *placed_at_ > recent_travel) {  // no factor has tied it to the map since
    placed_at_.reset();
    is_lost_ = true;
  }
  if (is_known_whether_lost_) return;
  const auto covariance = view.jointCovariance({frame.pose});
  if (!covariance) return;
  is_known_whether_lost_ = true;
  is_lost_ = std::sqrt(std::max((*covariance)(0, 0), (*covariance)(1, 1))) >= kLost;
}

// Readings of a sign from one spot count as one measurement, and only the latest few of each sign are kept.
void SessionBySigns::remember(const map::KeyFrame& frame, const KnownSignBearing& known, double travelled,
                              double recent_travel) {
  constexpr double kSpot = 0.2;  // [m]
  constexpr std::ptrdiff_t kMostOfOne = 5;
  const auto isOld = [&](const RecentBearing& seen) { return travelled - seen.travelled > recent_travel; };
  seen_.erase(std::remove_if(seen_.begin(), seen_.end(), isOld), seen_.end());
  const auto isSame = [&](const RecentBearing& seen) { return seen.known.sign == known.sign; };
  const auto last = std::find_if(seen_.rbegin(), seen_.rend(), isSame);
  if (last != seen_.rend() && travelled - last->travelled < kSpot) return;
  if (std::count_if(seen_.begin(), seen_.end(), isSame) >= kMostOfOne)
    seen_.erase(std::find_if(seen_.begin(), seen_.end(), isSame));
  constexpr std::size_t kMost = 30;
  if (seen_.size() >= kMost) seen_.pop_front();
  seen_.push_back({frame.id, known, travelled});
}

std::optional<SessionFit> SessionBySigns::fit(const mapper::View& view) const {
  std::vector<KnownSignBearing> measurements;
  for (const auto& seen : seen_) {
    const auto* frame = view.map.key_frames.find(seen.frame);
    if (!frame) continue;
    measurements.push_back(seen.known);
    measurements.back().session_from_base = geometry::fromMrpt(frame->map_from_base);
  }
  return resection(measurements);
}

std::optional<SessionBySigns::Placement> SessionBySigns::take(const std::vector<SignMeasurement>& measurements,
                                                              const map::KeyFrame& frame, const SignTracks& tracks,
                                                              const mapper::View& view, const KnownOffsets& offsets,
                                                              double recent_travel) {
  learnState(frame, tracks, view, recent_travel);
  if (!is_lost_) return std::nullopt;
  bool has_known = false;
  std::optional<KnownSignBearing> numbered;
  for (const auto& measurement : measurements) {
    const auto sign = oneWith(measurement.text, tracks, view);
    if (!sign) continue;
    const auto known = seenKnown(measurement, *sign, frame, tracks, view, offsets);
    if (!known) continue;
    has_known = true;
    if (known->is_numbered) numbered = known;
    remember(frame, *known, tracks.travelled(), recent_travel);
  }
  if (!has_known) return std::nullopt;
  if (const auto found = fit(view)) {
    is_lost_ = false;
    is_guessed_ = true;
    placed_at_ = tracks.travelled();
    const std::string reason = std::to_string(found->fitting) + " of " + std::to_string(seen_.size()) +
                               " measurements of signs fit one place of the map: the session is moved there";
    seen_.clear();
    const auto pose = geometry::toMrpt(found->map_from_session * geometry::fromMrpt(frame.map_from_base));
    return Placement{{frame.id, {pose, found->position_sigma, found->angle_sigma}}, true, reason};
  }
  if (is_guessed_ || !numbered) return std::nullopt;
  is_guessed_ = true;
  return Placement{
      guessBefore(*numbered, frame), false,
      "the map has only one sign with the text that is read: the session is moved in front of it, and waits "
      "for others that agree"};
}

}  // namespace omnimapper::plugins
