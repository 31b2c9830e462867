#include "MapConsistency.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/matching/WallCrossings.h>
#include <omnimapper/plugins/KnownPlaces.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "../PlanarMotion.h"

namespace omnimapper::plugins {

using mapper::Evidence;

namespace {

template <class... Numbers>
std::string format(const char* pattern, Numbers... numbers) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, numbers...);
  return text;
}

}  // namespace

Evidence scansThroughWalls(const map::Map& map, const std::vector<std::string>& labels) {
  constexpr double kCrossed = 0.2;       // share of a scan's beams that no people, glass or doors explain
  constexpr double kMostPercent = 0.5;   // of scans
  constexpr std::size_t kFewBeams = 20;  // say nothing of a scan
  Evidence evidence{"scans_through_walls_percent", 0, Evidence::Says::too_little,
                    "there are no 2D scans to judge it by"};
  std::vector<matching::PlacedScan> scans;
  std::vector<base::Stamp> stamps;
  for (const auto& frame : map.key_frames) {
    for (const auto& label : labels) {
      auto seen = beamsInBase(frame, label);
      if (seen.scan.hits.size() < kFewBeams) continue;
      scans.push_back({planar(frame.map_from_base) + seen.local_from_sensor, std::move(seen.scan)});
      stamps.push_back(frame.stamp);
    }
  }
  if (scans.empty()) return evidence;
  std::size_t bad = 0, worst = 0;
  double worst_share = 0;
  try {
    const auto sums = matching::crossedWalls(scans);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const double share =
          static_cast<double>(sums[i].crossed) / static_cast<double>(std::max(kFewBeams, sums[i].beams));
      bad += share > kCrossed;
      if (share <= worst_share) continue;
      worst = i;
      worst_share = share;
    }
  } catch (const base::Error& error) {
    evidence.reason = error.what();
    return evidence;
  }
  evidence.value = 100.0 * static_cast<double>(bad) / static_cast<double>(scans.size());
  if (evidence.value > kMostPercent) {
    evidence.says = Evidence::Says::against_it;
    evidence.reason = format(
        "in %zu of %zu scans a fifth of the beams or more pass through walls of the map, most of all %.0f s after the "
        "start",
        bad, scans.size(), base::secondsBetween(map.key_frames.begin()->stamp, stamps[worst]));
  } else {
    evidence.says = Evidence::Says::good;
    evidence.reason = bad == 0 ? "no scan looks through walls of the map"
                               : format("%zu of %zu scans look through walls of the map", bad, scans.size());
  }
  return evidence;
}

namespace {

// One place for each key frame, with the distance travelled until there; sessions follow one another.
struct Stop {
  base::KeyFrameId id;
  double x, y, yaw, way;
};

std::vector<Stop> stopsOf(const map::Map& map, double between_sessions) {
  std::vector<Stop> stops;
  double way = 0;
  for (const auto& frame : map.key_frames) {
    const auto pose = planar(frame.map_from_base);
    if (!stops.empty()) {
      const bool same = stops.back().id.session == frame.id.session;
      way += same ? std::hypot(pose.x - stops.back().x, pose.y - stops.back().y) : between_sessions;
    }
    stops.push_back({frame.id, pose.x, pose.y, pose.phi, way});
  }
  return stops;
}

// Key frames by the square of the floor they are in.
class Squares {
 public:
  explicit Squares(double side) : side_(side) {}
  void add(const Stop& stop, std::size_t index) { squares_[keyOf(cell(stop.x), cell(stop.y))].push_back(index); }
  // Those in the same square and the eight around it.
  template <class Use>
  void forEachNear(const Stop& stop, const Use& use) const {
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const auto found = squares_.find(keyOf(cell(stop.x) + dx, cell(stop.y) + dy));
        if (found == squares_.end()) continue;
        for (const std::size_t index : found->second) use(index);
      }
    }
  }

 private:
  std::int64_t cell(double x) const { return static_cast<std::int64_t>(std::floor(x / side_)); }
  static std::int64_t keyOf(std::int64_t x, std::int64_t y) { return x * 0x100000001 + y; }
  double side_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> squares_;
};

}  // namespace

std::vector<Evidence> revisits(const mapper::View& view, const std::string& section, double min_way) {
  constexpr double kNear = 2.0, kAngle = 0.8;  // [m] [rad] within which two scans of 180 deg see much the same
  constexpr double kTied = 15;                 // [m] of travel from a closure within which a revisit counts as tied
  const auto stops = stopsOf(view.map, 2 * min_way);
  std::set<base::KeyFrameId> closed;
  std::size_t accepted = 0, refused = 0, unlike = 0;
  for (const auto& decision : view.decisions) {
    if (decision.plugin != section || !decision.to) continue;
    ++(decision.accepted ? accepted : refused);
    unlike += decision.reason == "nothing alike";
    if (decision.accepted) closed.insert(decision.from);
  }
  Squares squares(kNear);
  std::vector<double> closure_ways;
  for (const auto& stop : stops) {
    if (closed.count(stop.id) > 0) closure_ways.push_back(stop.way);
  }
  const auto isTied = [&](double way) {
    const auto next = std::lower_bound(closure_ways.begin(), closure_ways.end(), way - kTied);
    return next != closure_ways.end() && *next <= way + kTied;
  };
  double revisited = 0, untied = 0, longest_untied = 0, stretch = 0, stretch_at = 0;
  std::size_t entered = 0;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    while (entered < i && stops[i].way - stops[entered].way >= min_way) {
      squares.add(stops[entered], entered);
      ++entered;
    }
    bool again = false;
    squares.forEachNear(stops[i], [&](std::size_t other) {
      again = again || (std::hypot(stops[i].x - stops[other].x, stops[i].y - stops[other].y) < kNear &&
                        std::abs(mrpt::math::wrapToPi(stops[i].yaw - stops[other].yaw)) < kAngle);
    });
    const double step = i > 0 ? stops[i].way - stops[i - 1].way : 0;
    if (!again) {
      stretch = 0;
      continue;
    }
    revisited += step;
    if (isTied(stops[i].way)) {
      stretch = 0;
      continue;
    }
    untied += step;
    stretch += step;
    if (stretch > longest_untied) {
      longest_untied = stretch;
      stretch_at =
          base::secondsBetween(view.map.keyFrame(stops.front().id).stamp, view.map.keyFrame(stops[i].id).stamp);
    }
  }
  std::vector<Evidence> all;
  all.push_back({"revisited_m", revisited, revisited > 0 ? Evidence::Says::good : Evidence::Says::too_little,
                 revisited > 0 ? format("%zu closures tie %.0f m that were driven again", accepted, revisited - untied)
                               : "the robot never came back to a place that it had seen before"});
  constexpr double kLong = 10;  // [m]
  const bool is_open = longest_untied > kLong;
  all.push_back({"revisited_without_closure_m", untied, is_open ? Evidence::Says::against_it : Evidence::Says::good,
                 is_open
                     ? format("for %.0f m, %.0f s after the start, it drives where it has been before and recognizes "
                              "nothing",
                              longest_untied, stretch_at)
                     : ""});
  all.push_back({"closures_refused", static_cast<double>(refused), Evidence::Says::good, ""});
  all.push_back({"searches_nothing_alike", static_cast<double>(unlike), Evidence::Says::good, ""});
  return all;
}

}  // namespace omnimapper::plugins
