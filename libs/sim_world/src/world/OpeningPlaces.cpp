#include "OpeningPlaces.h"

#include <omnimapper/sim_world/Footprint.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;
using Kind = OpeningPlan::Kind;

constexpr double kToCorner = 0.25;        // smallest distance from an opening to the end of its wall [m]
constexpr double kToBorder = 0.15;        // half of the smallest distance between two openings [m]
constexpr double kFacing = 0.5;           // rooms that are nearer to each other than this face each other [m]
constexpr double kFreeOfLeaves = 0.9;     // depth of the floor before and behind a doorway in which no leaf stands [m]
constexpr double kLeafMargin = 0.12;      // around a leaf [m]
constexpr double kNarrowestWindow = 0.5;  // [m]
constexpr int kPlaceAttempts = 50;

struct WallInterval {
  double low, high;
};

// An opening in a wall of its first room.
struct OpeningSite {
  OpeningPlan* opening;
  int along;          // axis of the wall
  bool is_high;       // whether the wall is at the upper end of the room across the other axis
  double line;        // coordinate of the wall across that axis [m]
  WallInterval free;  // part of the wall that the opening may take [m]
  bool has_leaf() const { return opening->kind == Kind::door && opening->leaf == OpeningPlan::Leaf::open; }
  double at() const { return along == 0 ? opening->x : opening->y; }
  void moveTo(double coordinate) { (along == 0 ? opening->x : opening->y) = coordinate; }
};

const RoomPlan* find(const WorldPlan& plan, const std::string& name) {
  const auto room =
      std::find_if(plan.rooms.begin(), plan.rooms.end(), [&](const RoomPlan& r) { return r.name == name; });
  return room == plan.rooms.end() ? nullptr : &*room;
}

// The wall of the first room that is nearest to the opening's place; none if a room is where the outside should be.
std::optional<OpeningSite> siteOf(const WorldPlan& plan, OpeningPlan& opening) {
  const RoomPlan& room = *find(plan, opening.rooms[0]);
  const Bounds bounds = boundsOf(room.outline);
  const Vector2d at(opening.x, opening.y);
  OpeningSite site{&opening, 0, false, 0, {}};
  double nearest = 1e9;
  for (const int across : {0, 1}) {
    for (const bool is_high : {false, true}) {
      const double line = (is_high ? bounds.high : bounds.low)[across];
      if (std::abs(at[across] - line) >= nearest) continue;
      nearest = std::abs(at[across] - line);
      site = {&opening, 1 - across, is_high, line, {bounds.low[1 - across], bounds.high[1 - across]}};
    }
  }
  const int along = site.along, across = 1 - along;
  for (const RoomPlan& other : plan.rooms) {
    if (other.name == room.name) continue;
    const Bounds there = boundsOf(other.outline);
    const double gap = site.is_high ? there.low[across] - site.line : site.line - there.high[across];
    const bool faces = gap > -kFloorTolerance && gap < kFacing && there.low[along] < site.free.high &&
                       there.high[along] > site.free.low;
    if (other.name == opening.rooms[1]) {
      site.free = {std::max(site.free.low, there.low[along]), std::min(site.free.high, there.high[along])};
    } else if (opening.rooms[1] == "outside" && faces) {
      if (at[along] > there.low[along] && at[along] < there.high[along]) return {};
      if (at[along] <= there.low[along]) site.free.high = std::min(site.free.high, there.low[along]);
      if (at[along] >= there.high[along]) site.free.low = std::max(site.free.low, there.high[along]);
    }
  }
  site.free.low += kToCorner;
  site.free.high -= kToCorner;
  return site;
}

bool isInOneWall(const OpeningSite& a, const OpeningSite& b) {
  return a.along == b.along && std::abs(a.line - b.line) < kFacing;
}

// Gives every opening the part of its wall that is nearer to its place than to that of any other opening.
void shareWalls(std::vector<OpeningSite>& sites) {
  for (OpeningSite& site : sites) {
    for (const OpeningSite& other : sites) {
      if (&other == &site || !isInOneWall(site, other)) continue;
      const double border = (site.at() + other.at()) / 2;
      if (other.at() > site.at()) site.free.high = std::min(site.free.high, border - kToBorder);
      if (other.at() < site.at()) site.free.low = std::max(site.free.low, border + kToBorder);
    }
  }
}

// A rectangle at the wall: an interval along it, and how far it reaches into the first room and out of it.
Ring boxAt(const OpeningSite& site, const WallInterval& interval, double in, double out) {
  const double inner = site.line + (site.is_high ? -in : in), outer = site.line + (site.is_high ? out : -out);
  Vector2d low, high;
  low[site.along] = interval.low;
  high[site.along] = interval.high;
  low[1 - site.along] = std::min(inner, outer);
  high[1 - site.along] = std::max(inner, outer);
  return rectangle(low, high);
}

WallInterval openPart(const OpeningSite& site) {
  return {site.at() - site.opening->width / 2, site.at() + site.opening->width / 2};
}

// The floor on both sides of a doorway; empty for a window.
Ring doorwayOf(const OpeningSite& site) {
  return site.opening->kind == Kind::window ? Ring() : boxAt(site, openPart(site), kFreeOfLeaves, kFreeOfLeaves);
}

// The floor that an open leaf takes, which stands at right angles to its wall. Seen from the room, left is the lower
// end of walls at low x and high y.
Ring leafOf(const OpeningSite& site) {
  if (!site.has_leaf()) return {};
  const bool left_is_low = (site.along == 0) == site.is_high;
  const WallInterval open = openPart(site);
  const double hinge = left_is_low != site.opening->hinge_right ? open.low : open.high;
  return boxAt(site, {hinge - kLeafMargin, hinge + kLeafMargin}, site.opening->width + kLeafMargin, 0);
}

bool overlapIfAny(const Ring& a, const Ring& b) {
  return !a.empty() && !b.empty() && convexOverlap(a, b);
}

bool obstructEachOther(const OpeningSite& a, const OpeningSite& b) {
  return overlapIfAny(leafOf(a), doorwayOf(b)) || overlapIfAny(leafOf(b), doorwayOf(a)) ||
         overlapIfAny(leafOf(a), leafOf(b));
}

// Draws a place in the wall where the opening obstructs none of the others. Returns whether there is one.
bool drawPlace(OpeningSite& site, const std::vector<OpeningSite>& placed, Random& random) {
  OpeningPlan& opening = *site.opening;
  const double most = site.free.high - site.free.low;
  if (opening.kind == Kind::window) {
    opening.width = std::floor(100 * std::min(opening.width * random.uniform(0.8, 1.3), most)) / 100;
    if (opening.width < kNarrowestWindow) return false;
  }
  if (most < opening.width) return false;
  for (int attempt = 0; attempt < kPlaceAttempts; ++attempt) {
    const double half = opening.width / 2;
    site.moveTo(std::round(1000 * random.uniform(site.free.low + half, site.free.high - half)) / 1000);
    if (site.has_leaf()) opening.hinge_right = random.chance(0.5);
    const bool is_in_the_way = std::any_of(placed.begin(), placed.end(),
                                           [&](const OpeningSite& other) { return obstructEachOther(site, other); });
    if (!is_in_the_way) return true;
  }
  return false;
}

bool leadsOutside(const OpeningPlan& opening) {
  return opening.rooms[1] == "outside";
}

}  // namespace

void redrawOpeningPlaces(WorldPlan& plan, Random& random) {
  std::vector<OpeningSite> sites;
  std::set<std::string> without_place;
  for (OpeningPlan& opening : plan.openings) {
    if (opening.width == 0) continue;
    if (const auto site = siteOf(plan, opening)) {
      sites.push_back(*site);
    } else {
      without_place.insert(opening.name);
    }
  }
  shareWalls(sites);
  std::stable_partition(sites.begin(), sites.end(), [](const OpeningSite& s) { return !leadsOutside(*s.opening); });
  std::vector<OpeningSite> placed;
  for (OpeningSite& site : sites) {
    // A room needs its door, even one that obstructs another.
    if (drawPlace(site, placed, random) || !leadsOutside(*site.opening)) {
      placed.push_back(site);
    } else {
      without_place.insert(site.opening->name);
    }
  }
  auto& openings = plan.openings;
  openings.erase(std::remove_if(openings.begin(), openings.end(),
                                [&](const OpeningPlan& opening) { return without_place.count(opening.name) > 0; }),
                 openings.end());
}

}  // namespace omnimapper::sim
