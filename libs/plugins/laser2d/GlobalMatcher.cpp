#include "GlobalMatcher.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "PlanarMotion.h"

namespace omnimapper::plugins {

using mrpt::math::TPose2D;

namespace {
constexpr double kDegree = base::option_text::kRadiansPerDegree;
constexpr double kQueryTravel = 4;  // [m] of travel whose scans are matched together
}  // namespace

std::optional<GlobalMatcher::Found> GlobalMatcher::find(const mapper::State& state, mapper::Decision& decision) const {
  constexpr std::size_t kAround = 30;                 // key frames of the map around the place, to match with
  constexpr double kAstray = 0.5, kAstrayTurn = 0.2;  // [m] [rad] that the fine match may differ from the answer
  constexpr double kSpacing = 0.08;                   // [m] between the points of a match
  // If more places of the map than this look alike, unmapped places probably do, too: the match needs more evidence.
  constexpr std::size_t kDistinct = 3;
  const auto location = locate(state, decision);
  if (location.answer != matching::Location::Answer::found) return std::nullopt;
  const TPose2D map_from_base = location.candidates.front().map_from_sensor;
  const auto around = places_.nearest(map_from_base, kAround);
  decision.to = around.front().key_scan.frame;
  const TPose2D place_from_base = map_from_base - around.front().map_from_base;
  std::vector<LoopSearch::KeyScan> key_scans, query_scans;
  for (const auto& place : around) key_scans.push_back(place.key_scan);
  std::copy_if(
      newest_.begin(), newest_.end(), std::back_inserter(query_scans),
      [&](const LoopSearch::KeyScan& key_scan) { return newest_.back().travel - key_scan.travel <= kQueryTravel; });
  const auto local = matching::voxelDownsample(localMap(key_scans, key_scans.front().frame, state), kSpacing / 2),
             query = matching::voxelDownsample(localMap(query_scans, newest_.back().frame, state), kSpacing);
  const auto match = matcher_.match(*matcher_.prepare(local), query, place_from_base);
  judgeClosure(options_, {match}, place_from_base, decision);
  if (decision.accepted && !distanceBetween(match.reference_from_scan, place_from_base).within(kAstray, kAstrayTurn)) {
    decision.accepted = false;
    decision.reason = "the fine match is far from the place that the search found";
  }
  if (!decision.accepted) return std::nullopt;
  return Found{around.front(), match, location.candidates.size() <= kDistinct};
}

// Leaves out scans close to others: they would see the same and only cost time.
std::vector<matching::LocalScan> GlobalMatcher::beams(const mapper::State& state) const {
  constexpr double kSpacing = 0.8, kTurn = 1;  // [m] [rad] from one scan to the next
  const auto& map_from_newest = state.map.keyFrame(newest_.back().frame).map_from_base;
  constexpr std::size_t kMost = 6;
  std::vector<matching::LocalScan> all;
  const LoopSearch::KeyScan* last = nullptr;
  TPose2D last_pose;
  for (auto key_scan = newest_.rbegin(); key_scan != newest_.rend() && all.size() < kMost; ++key_scan) {
    if (newest_.back().travel - key_scan->travel > kQueryTravel) break;
    const auto& frame = state.map.keyFrame(key_scan->frame);
    const TPose2D pose = planar(frame.map_from_base - map_from_newest);
    if (last && last->travel - key_scan->travel < kSpacing && distanceBetween(pose, last_pose).radians < kTurn)
      continue;
    last = &*key_scan;
    last_pose = pose;
    auto local = beamsInBase(frame, label_);
    all.push_back({pose + local.local_from_sensor, std::move(local.scan)});
  }
  return all;
}

matching::Location GlobalMatcher::locate(const mapper::State& state, mapper::Decision& decision) const {
  using Answer = matching::Location::Answer;
  matching::Location location;
  const auto scans = beams(state);
  try {
    location = places_.relocalizer().locateTogether(scans);
  } catch (const base::Error& error) {
    if (error.code() != base::ExitCode::out_of_range) throw;
    decision.reason = error.what();  // the map is too large for the relocalizer
    return location;
  }
  const auto& candidates = location.candidates;
  decision.numbers.emplace_back("scans", static_cast<double>(scans.size()));
  decision.numbers.emplace_back("similar places", static_cast<double>(candidates.size()));
  if (!candidates.empty()) {
    decision.numbers.emplace_back("probability", candidates[0].probability);
    decision.numbers.emplace_back("mean log-likelihood of a beam", candidates[0].log_likelihood);
  }
  if (candidates.size() > 1)
    decision.numbers.emplace_back("probability of the second place", candidates[1].probability);
  if (location.answer == Answer::ambiguous) decision.reason = "ambiguous: the scans fit elsewhere in the map as well";
  if (location.answer == Answer::none) decision.reason = "the scans fit nowhere in the map";
  return location;
}

bool GlobalMatcher::fitsAlongTravel(const Found& found, const mapper::State& state, mapper::Decision& decision) const {
  constexpr double kSpacing = 1.5;                            // [m] of travel from one scan to the next
  constexpr double kWindow = 0.5, kWindowTurn = 5 * kDegree;  // [m] [rad] of drift along it
  constexpr double kLeast = -0.8;  // smallest mean log-likelihood of the beams of a scan that fits
  const TPose2D map_from_newest = found.place.map_from_base + found.match.reference_from_scan;
  const auto& base_from_map = state.map.keyFrame(newest_.back().frame).map_from_base;
  const double travel = newest_.back().travel - newest_.front().travel;
  constexpr double kNothing = -10;
  double worst = 0;
  const LoopSearch::KeyScan* last = nullptr;
  for (auto key_scan = newest_.rbegin(); key_scan != newest_.rend(); ++key_scan) {
    if (last && last->travel - key_scan->travel < kSpacing) continue;
    last = &*key_scan;
    const auto& frame = state.map.keyFrame(key_scan->frame);
    const auto local = beamsInBase(frame, label_);
    const TPose2D guess = map_from_newest + planar(frame.map_from_base - base_from_map) + local.local_from_sensor;
    const auto located =
        places_.relocalizer().locate(local.scan, matching::SearchWindow{guess, kWindow, kWindow, kWindowTurn});
    const double likelihood = located.candidates.empty() ? kNothing : located.candidates.front().log_likelihood;
    worst = std::min(worst, likelihood);
  }
  decision.numbers.emplace_back("distance checked [m]", travel);
  decision.numbers.emplace_back("mean log-likelihood of a beam where it fits worst", worst);
  if (worst < kLeast) {
    decision.reason = "earlier scans on the path to the place do not fit the map";
    return false;
  }
  if (travel < options_.join_travel) {
    decision.reason = "too many places look alike: scans over a longer distance must fit";
    return false;
  }
  return true;
}

}  // namespace omnimapper::plugins
