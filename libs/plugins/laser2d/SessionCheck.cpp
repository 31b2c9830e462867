#include "SessionCheck.h"

#include <algorithm>
#include <optional>

#include "PlanarMotion.h"

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

namespace {

// [m] [rad] by which the pose of a scan may be off, in a map that is as it was and in one that bends
constexpr double kWindow = 0.3, kTurn = 0.06, kBent = 0.6, kBentTurn = 0.12;
constexpr double kFits = -0.8;        // least mean log-likelihood of the beams of a scan that fits
constexpr double kContradicts = 0.3;  // share of the beams of a scan that contradicts the map

// Where a key frame is in the map as it was saved: relative to the nearest place, because closures may have bent the
// map since. None where that is too uncertain to say anything.
std::optional<TPose2D> placeInSavedMap(const ScanDatabase& places, const map::KeyFrame& frame,
                                       const mapper::State& state) {
  constexpr double kUncertain = 0.25;  // [m] standard deviation
  const auto place = places.nearest(planar(frame.map_from_base), 1).front();
  const auto covariance = state.covarianceBetween(place.key_scan.frame, frame.id);
  if (!covariance || std::max((*covariance)(0, 0), (*covariance)(1, 1)) > kUncertain * kUncertain) return std::nullopt;
  return place.map_from_base + planar(frame.map_from_base - state.map.keyFrame(place.key_scan.frame).map_from_base);
}

struct Verdict {
  bool fits, contradicts;
  double contradicting;  // share of the beams
};

Verdict verdictOn(const ScanDatabase& places, const std::string& label, const map::KeyFrame& frame,
                  const TPose2D& map_from_base, double window = kWindow, double turn = kTurn) {
  constexpr double kHardly = 0.06;  // share of the beams; a scan that contradicts no more fits where it is
  const auto local = beamsInBase(frame, label);
  const TPose2D map_from_sensor = map_from_base + local.local_from_sensor;
  const auto& map = places.relocalizer();
  auto fit = map.fitAround(local.scan, map_from_sensor, 0, 0);
  if (fit.log_likelihood < kFits || fit.contradicting > kHardly)
    fit = map.fitAround(local.scan, map_from_sensor, window, turn);
  const bool is_empty = local.scan.hits.empty();
  return {!is_empty && fit.log_likelihood >= kFits, !is_empty && fit.contradicting > kContradicts, fit.contradicting};
}

}  // namespace

bool SessionCheck::confirms(bool agrees_with_start) const {
  constexpr double kApart = 3;             // [m] between two places
  constexpr double kMostContradict = 0.1;  // share of the scans
  constexpr double kMostBeams = 0.06;      // of the scans that fit: in mirror images some furniture differs
  if (!is_possible) return true;
  const bool is_seen = agrees_with_start ? fits > 0 && contradicting == 0 : fitting >= kApart;
  return is_seen && contradicting_beams <= kMostBeams &&
         static_cast<double>(contradicting) <= kMostContradict * static_cast<double>(scans);
}

SessionCheck checkSession(const ScanDatabase& places, const std::string& label,
                          const std::vector<LoopSearch::KeyScan>& newest, const TPose2D& map_from_newest,
                          const mapper::State& state) {
  constexpr double kSpacing = 1;  // [m] of travel from one scan to the next
  const auto& session_from_newest = state.map.keyFrame(newest.back().frame).map_from_base;
  SessionCheck fit;
  fit.is_possible = places.hasRelocalizer();
  if (!fit.is_possible) return fit;
  const LoopSearch::KeyScan *last = nullptr, *last_fitting = nullptr;
  for (auto key_scan = newest.rbegin(); key_scan != newest.rend(); ++key_scan) {
    if (last && last->travel - key_scan->travel < kSpacing) continue;
    last = &*key_scan;
    const auto& frame = state.map.keyFrame(key_scan->frame);
    const auto verdict =
        verdictOn(places, label, frame, map_from_newest + planar(frame.map_from_base - session_from_newest));
    ++fit.scans;
    fit.contradicting += verdict.contradicts;
    if (!verdict.fits) continue;
    ++fit.fits;
    fit.contradicting_beams += (verdict.contradicting - fit.contradicting_beams) / static_cast<double>(fit.fits);
    if (!last_fitting) last_fitting = last;
    fit.fitting = last_fitting->travel - key_scan->travel;
  }
  return fit;
}

void SessionWatch::add(const ScanDatabase& places, const std::string& label, const map::KeyFrame& frame, double travel,
                       const mapper::State& state) {
  constexpr double kSpacing = 0.5;  // [m] from one scan that is compared to the next
  constexpr std::size_t kKept = 6;
  travel_ = travel;
  if (!places.hasRelocalizer()) {
    confirmed_ = travel;  // nothing can tell
    return;
  }
  if (!latest_.empty() && travel - latest_.back().travel < kSpacing) return;
  const auto map_from_base = placeInSavedMap(places, frame, state);
  if (!map_from_base) return;
  const auto verdict =
      verdictOn(places, label, frame, *map_from_base, map_is_held_ ? kWindow : kBent, map_is_held_ ? kTurn : kBentTurn);
  latest_.push_back({travel, verdict.fits, verdict.contradicts});
  if (latest_.size() > kKept) latest_.pop_front();
  if (verdict.fits) confirmed_ = travel;
}

bool SessionWatch::isContradicted() const {
  constexpr std::ptrdiff_t kMost = 3;  // of the latest scans, as where furniture was moved
  return std::count_if(latest_.begin(), latest_.end(), [](const Scan& scan) { return scan.contradicts; }) > kMost;
}

bool SessionWatch::isConfirmed() const {
  constexpr double kRecent = 10;  // [m]
  return !isContradicted() && travel_ - confirmed_ <= kRecent;
}

}  // namespace omnimapper::plugins
