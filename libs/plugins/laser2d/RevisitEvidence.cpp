#include "RevisitEvidence.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/grid/LikelihoodPyramid.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "EvidenceText.h"
#include "PlanarMotion.h"
#include "ScanDatabase.h"
#include "SlipSearch.h"

namespace omnimapper::plugins {

using mapper::Evidence;
using mrpt::math::TPose2D;

namespace {

grid::LikelihoodPyramid wallsOf(const std::vector<Eigen::Vector2f>& points) {
  grid::LikelihoodOptions grid;
  grid.cell = 0.1;
  grid.sigma = 0.15;
  grid.levels = 1;
  return grid::LikelihoodPyramid(points, grid);
}

}  // namespace

double shareOnWalls(const std::vector<Eigen::Vector2f>& map, const std::vector<Eigen::Vector2f>& seen) {
  if (map.empty() || seen.empty()) return 0;
  return wallsOf(map).score(seen, TPose2D());
}

namespace {

// A key frame and the distance travelled until there [m].
struct Stop {
  TPose2D pose;
  double travelled;
  base::Stamp stamp;
  std::uint16_t session;
  bool is_tied = false;  // a closure ties it, or a stop nearby along the path, to an earlier one
};

std::vector<Stop> stopsOf(const map::Map& map, double between_sessions) {
  std::vector<Stop> stops;
  const map::KeyFrame* before = nullptr;
  for (const auto& frame : map.key_frames) {
    Stop stop{planar(frame.map_from_base), 0, frame.stamp, frame.id.session};
    if (before) {
      const TPose2D& last = stops.back().pose;
      const bool same = before->id.session == frame.id.session;
      stop.travelled =
          stops.back().travelled + (same ? std::hypot(stop.pose.x - last.x, stop.pose.y - last.y) : between_sessions);
    }
    stops.push_back(stop);
    before = &frame;
  }
  return stops;
}

// Distance travelled from the previous stop to this one [m]; 0 between sessions.
double drivenTo(const std::vector<Stop>& stops, std::size_t i) {
  return stops[i].session == stops[i - 1].session ? stops[i].travelled - stops[i - 1].travelled : 0;
}

// Marks the stops within `reach` [m] of travel around the later end of an active closure, and returns the number of
// active closures. They are read from the graph, because the decisions of this run lack those of earlier sessions.
std::size_t markTied(const mapper::State& state, const std::string& section, double reach, std::vector<Stop>& stops) {
  std::map<base::VariableId, std::size_t> stop_of;
  for (std::size_t i = 0; i < stops.size(); ++i) stop_of[state.map.key_frames[i].pose] = i;
  std::size_t closures = 0;
  for (const auto& [id, record] : state.graph.factors()) {
    if (record.tags.owner != section || record.tags.note == kSlip || record.weight <= 0) continue;
    std::size_t poses = 0, latest = 0;
    for (const auto variable : record.variables) {
      const auto found = stop_of.find(variable);
      if (found == stop_of.end()) continue;
      ++poses;
      latest = std::max(latest, found->second);
    }
    if (poses < 2) continue;
    ++closures;
    const double there = stops[latest].travelled;
    for (std::size_t i = latest; i < stops.size() && stops[i].travelled <= there + reach; ++i) stops[i].is_tied = true;
    for (std::size_t i = latest; i-- > 0 && stops[i].travelled >= there - reach;) stops[i].is_tied = true;
  }
  return closures;
}

// A grid of squares on the floor, with the stops in each.
class Squares {
 public:
  explicit Squares(double side) : side_(side) {}
  void add(const Stop& stop, std::size_t index) { squares_[{cell(stop.pose.x), cell(stop.pose.y)}].push_back(index); }
  // The stop with the smallest index among those in the same square or the eight around it for which `holds` is true.
  template <class Condition>
  std::optional<std::size_t> firstNear(const Stop& stop, const Condition& holds) const {
    std::optional<std::size_t> first;
    for (const double dx : {-1, 0, 1}) {
      for (const double dy : {-1, 0, 1}) {
        const auto square = squares_.find({cell(stop.pose.x) + dx, cell(stop.pose.y) + dy});
        if (square == squares_.end()) continue;
        const auto found = std::find_if(square->second.begin(), square->second.end(), holds);
        if (found != square->second.end()) first = std::min(*found, first.value_or(*found));
      }
    }
    return first;
  }

 private:
  // A whole number, as a double because coordinates have no bound.
  double cell(double x) const { return std::floor(x / side_); }
  double side_;
  std::map<std::pair<double, double>, std::vector<std::size_t>> squares_;
};

// How the points seen at a stop fit points seen nearby at least `min_travel` [m] of travel earlier. They lie on them
// where the map is right. Along a bare corridor they also do where it is wrong, and show nothing.
enum class Fit { none, anywhere, here };

Fit fitOf(const std::vector<Eigen::Vector2f>& before, const std::vector<Eigen::Vector2f>& seen) {
  constexpr double kFits = 0.5;    // share of the points seen
  constexpr double kShift = 0.75;  // [m]
  constexpr double kAlike = 0.95;  // share that is left of it after a shift that makes no difference
  constexpr int kDirections = 8;
  if (before.empty() || seen.empty()) return Fit::none;
  const auto walls = wallsOf(before);
  const double share = walls.score(seen, TPose2D());
  if (share <= kFits) return Fit::none;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2 * M_PI * k / kDirections;
    if (walls.score(seen, TPose2D(kShift * std::cos(angle), kShift * std::sin(angle), 0)) > kAlike * share)
      return Fit::anywhere;
  }
  return Fit::here;
}

Fit fitWithSeenBefore(const map::Map& map, const std::vector<std::string>& labels, const std::vector<Stop>& stops,
                      std::size_t at, double min_travel) {
  constexpr double kNear = 6;  // [m] from the stop, from where most of the same walls were visible
  constexpr std::size_t kMost = 12;
  std::vector<Eigen::Vector2f> before, seen;
  const auto add = [&](std::size_t i, std::vector<Eigen::Vector2f>& points) {
    const TPose2D here_from_base = stops[i].pose - stops[at].pose;
    for (const auto& label : labels) {
      const auto beams = beamsInBase(*std::next(map.key_frames.begin(), static_cast<std::ptrdiff_t>(i)), label);
      const TPose2D here_from_sensor = here_from_base + beams.local_from_sensor;
      for (const auto& hit : beams.scan.hits) {
        const auto point = here_from_sensor.composePoint({hit.x(), hit.y()});
        points.emplace_back(static_cast<float>(point.x), static_cast<float>(point.y));
      }
    }
  };
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < at && stops[at].travelled - stops[i].travelled >= min_travel; ++i) {
    const double apart = std::hypot(stops[i].pose.x - stops[at].pose.x, stops[i].pose.y - stops[at].pose.y);
    if (apart < kNear) near.emplace_back(apart, i);
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), kMost));
  for (const auto& [apart, i] : near) add(i, before);
  add(at, seen);
  return fitOf(before, seen);
}

// For each stop, the first stop near it that was passed at least `min_travel` [m] of travel earlier.
std::vector<std::optional<std::size_t>> revisiting(const std::vector<Stop>& stops, double min_travel) {
  constexpr double kNear = 2.0, kAngle = 0.8;  // [m] [rad] within which two scans of 180 deg see much the same
  Squares squares(kNear);
  std::vector<std::optional<std::size_t>> again(stops.size());
  std::size_t entered = 0;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    for (; entered < i && stops[i].travelled - stops[entered].travelled >= min_travel; ++entered)
      squares.add(stops[entered], entered);
    again[i] = squares.firstNear(stops[i], [&](std::size_t other) {
      const TPose2D &here = stops[i].pose, &there = stops[other].pose;
      return std::hypot(here.x - there.x, here.y - there.y) < kNear &&
             std::abs(mrpt::math::wrapToPi(here.phi - there.phi)) < kAngle;
    });
  }
  return again;
}

// Share of the travel that lies between two visits of a place: only there does an error of the trajectory show.
// `begins`: for each stop, the first stop that it is known to revisit.
Evidence spannedTravel(const std::vector<Stop>& stops, const std::vector<std::optional<std::size_t>>& begins) {
  constexpr double kEnough = 25;  // percent
  double travel = 0, spanned = 0;
  std::size_t begin = stops.size();
  for (std::size_t i = stops.size(); i-- > 1;) {
    begin = std::min(begin, begins[i].value_or(begin));
    const double step = drivenTo(stops, i);
    travel += step;
    if (begin < i) spanned += step;
  }
  Evidence evidence{"travel_between_visits_percent", travel > 0 ? 100 * spanned / travel : 0, Evidence::Says::good, ""};
  if (evidence.value < kEnough) {
    evidence.says = Evidence::Says::too_little;
    evidence.reason = evidenceText(
        "only %.0f m of the %.0f m driven lie between two visits of a place, and nothing confirms the rest", spanned,
        travel);
  }
  return evidence;
}

}  // namespace

std::vector<Evidence> revisits(const mapper::State& state, const std::string& section,
                               const std::vector<std::string>& labels, double min_travel) {
  constexpr double kTied = 15;  // [m] of travel from a closure within which a revisit counts as recognized
  constexpr double kLong = 10;  // [m] of a stretch that is neither recognized nor fits
  auto stops = stopsOf(state.map, 2 * min_travel);
  const std::size_t closures = markTied(state, section, kTied, stops);
  const auto again = revisiting(stops, min_travel);
  std::vector<std::optional<std::size_t>> known(stops.size());
  double revisited = 0, untied = 0, fitting = 0, open = 0, stretch = 0, longest = 0;
  std::size_t longest_until = 0;
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const double step = again[i] ? drivenTo(stops, i) : 0;
    revisited += step;
    const bool is_tied = !again[i] || stops[i].is_tied;
    const Fit fit = is_tied ? Fit::here : fitWithSeenBefore(state.map, labels, stops, i, min_travel);
    if (fit == Fit::here) known[i] = again[i];
    stretch = fit == Fit::none ? stretch + step : 0;
    if (fit == Fit::none) untied += step;
    if (fit == Fit::anywhere) open += step;
    if (fit == Fit::here && !stops[i].is_tied) fitting += step;
    if (stretch > longest) {
      longest = stretch;
      longest_until = i;
    }
  }
  Evidence again_m{"revisited_m", revisited, Evidence::Says::good, ""};
  const double tied = std::max(0.0, revisited - untied - fitting - open);
  if (tied > 0) {
    again_m.reason = evidenceText("%s%s %s %.1f m that were driven again", base::counted(closures, "closure").c_str(),
                                  state.map.sessions.size() > 1 ? " of all sessions" : "",
                                  closures == 1 ? "confirms" : "confirm", tied);
  }
  if (fitting > 0) {
    again_m.reason +=
        evidenceText(tied > 0 ? ", and on %.1f m more the scans fit what was seen there before"
                              : "on %.1f m that were driven again the scans fit what was seen there before",
                     fitting);
  }
  if (revisited == 0) {
    again_m.says = Evidence::Says::too_little;
    again_m.reason = "the robot never came back to a place that it had seen before";
  }
  if (open > 0 && tied + fitting == 0) {
    again_m.says = Evidence::Says::too_little;
    again_m.reason =
        evidenceText("the robot came back only along bare walls, where the scans fit everywhere (%.1f m)", open);
  }
  Evidence untied_m{"revisited_without_closure_m", untied, Evidence::Says::good, ""};
  if (longest > kLong) {
    untied_m.says = Evidence::Says::against_it;
    untied_m.reason = evidenceText(
        "for %.0f m, until %s, the map has the robot where it was before, but the scans show something else", longest,
        afterStart(state.map, state.map.key_frames[longest_until]).c_str());
  }
  Evidence spanned = spannedTravel(stops, known);
  if (revisited == 0) spanned.reason.clear();  // the first reason says so already
  return {again_m, untied_m, spanned};
}

}  // namespace omnimapper::plugins
