#include "WallEvidence.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/matching/WallCrossings.h>

#include <algorithm>
#include <utility>

#include "EvidenceText.h"
#include "PlanarMotion.h"
#include "ScanDatabase.h"

namespace omnimapper::plugins {

using mapper::Evidence;

namespace {

struct Scans {
  std::vector<matching::MapScan> scans;
  std::vector<const map::KeyFrame*> frames;  // of each scan
};

constexpr std::size_t kFewBeams = 20;  // beams of a scan that is too small to judge

Scans scansOf(const map::Map& map, const std::vector<std::string>& labels) {
  Scans all;
  for (const auto& frame : map.key_frames) {
    for (const auto& label : labels) {
      auto beams = beamsInBase(frame, label);
      if (beams.scan.hits.size() < kFewBeams) continue;
      all.scans.push_back({planar(frame.map_from_base) + beams.local_from_sensor, std::move(beams.scan)});
      all.frames.push_back(&frame);
    }
  }
  return all;
}

struct Track {
  std::vector<matching::TrackStep> steps;
  std::vector<const map::KeyFrame*> frames;  // at the end of each step
};

// The steps from key frame to key frame. A long one, across a gap, is left out: the way between its ends is not known.
Track trackOf(const map::Map& map) {
  constexpr double kLongest = 2;  // [m]
  Track track;
  const map::KeyFrame* before = nullptr;
  for (const auto& frame : map.key_frames) {
    if (before && before->id.session == frame.id.session) {
      const Eigen::Vector2d from(before->map_from_base.x(), before->map_from_base.y()),
          to(frame.map_from_base.x(), frame.map_from_base.y());
      if ((to - from).norm() < kLongest) {
        track.steps.push_back({from, to});
        track.frames.push_back(&frame);
      }
    }
    before = &frame;
  }
  return track;
}

Evidence scansThroughWalls(const matching::WallCrossings& crossings, const Scans& scans, const map::Map& map) {
  constexpr double kCrossed = 0.2;      // share of a scan's beams, more than people, glass and doors explain
  constexpr double kMostPercent = 0.5;  // of scans
  std::size_t bad = 0, worst = 0;
  double worst_share = 0;
  const auto& sums = crossings.scans;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double share = static_cast<double>(sums[i].crossed) / static_cast<double>(std::max(kFewBeams, sums[i].beams));
    bad += share > kCrossed;
    if (share <= worst_share) continue;
    worst = i;
    worst_share = share;
  }
  const std::size_t count = scans.scans.size();
  Evidence evidence{"scans_through_walls_percent", 100.0 * static_cast<double>(bad) / static_cast<double>(count),
                    Evidence::Says::good, "no scan looks through walls of the map"};
  if (evidence.value > kMostPercent) {
    evidence.says = Evidence::Says::against_it;
    evidence.reason = evidenceText(
        "in %zu of %zu scans at least a fifth of the beams pass through walls of the map, the worst scan %s", bad,
        count, afterStart(map, *scans.frames[worst]).c_str());
  } else if (bad > 0) {
    evidence.reason = evidenceText("%zu of %zu scans look through walls of the map", bad, count);
  }
  return evidence;
}

Evidence trackThroughWalls(const matching::WallCrossings& crossings, const Track& track, const map::Map& map) {
  constexpr std::size_t kMost = 1;  // a door that closed behind the robot, or one cell of clutter
  const auto count = static_cast<std::size_t>(std::count(crossings.steps.begin(), crossings.steps.end(), true));
  Evidence evidence{"track_through_walls", static_cast<double>(count), Evidence::Says::good, ""};
  if (count > kMost) {
    const auto first = std::find(crossings.steps.begin(), crossings.steps.end(), true) - crossings.steps.begin();
    evidence.says = Evidence::Says::against_it;
    evidence.reason = evidenceText("the track of the robot leads through walls of the map %zu times, first %s", count,
                                   afterStart(map, *track.frames[static_cast<std::size_t>(first)]).c_str());
  }
  return evidence;
}

}  // namespace

std::vector<Evidence> throughWalls(const map::Map& map, const std::vector<std::string>& labels) {
  Evidence nothing{"scans_through_walls_percent", 0, Evidence::Says::too_little,
                   "there are no 2D scans to check the map with"};
  const auto scans = scansOf(map, labels);
  if (scans.scans.empty()) return {nothing};
  const auto track = trackOf(map);
  try {
    const auto crossings = matching::crossedWalls(scans.scans, {}, track.steps);
    if (crossings.walls > 0)
      return {scansThroughWalls(crossings, scans, map), trackThroughWalls(crossings, track, map)};
    nothing.reason = "no wall was seen from enough places to check the map with";
  } catch (const base::Error& error) {
    nothing.reason = error.what();
  }
  return {nothing};
}

}  // namespace omnimapper::plugins
