#include "PlanVariation.h"

#include <omnimapper/sim_world/Footprint.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "OpeningPlaces.h"

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;

constexpr std::uint64_t kPlanStream = 0x9e1;
constexpr double kNominalWall = 0.12;                              // thickness in the fixed plans [m]
constexpr double kNominalCeiling = 2.7;                            // [m]
constexpr double kThinnestWall = 0.08, kThickestWall = 0.24;       // [m]
constexpr double kNarrowestCorridor = 1.5, kWidestCorridor = 2.4;  // [m]
constexpr double kLowestCeiling = 2.4, kHighestCeiling = 3.0;      // [m]
// Factors on the distances between two lines of the plan. With the walls in it a room stays within 80 to 130 %.
constexpr double kSmallestFactor = 0.82, kLargestFactor = 1.25;
constexpr double kSameLine = 1e-6;  // [m]

// Rounds to a centimetre.
double rounded(double metres) {
  return std::round(100 * metres) / 100;
}

bool isNarrowAlong(const RoomPlan& room, int axis) {
  const Bounds bounds = boundsOf(room.outline);
  const Vector2d size = bounds.high - bounds.low;
  return (room.kind == "corridor" || room.kind == "hallway") && size[axis] < size[1 - axis];
}

}  // namespace

double PlanVariation::Axis::at(double coordinate) const {
  std::size_t i = 1;
  while (i + 1 < from.size() && coordinate > from[i]) ++i;
  // A line of the fixed plan becomes exactly that of the drawn one, for all rooms that it bounds.
  if (std::abs(coordinate - from[i]) < kSameLine) return to[i];
  if (std::abs(coordinate - from[i - 1]) < kSameLine) return to[i - 1];
  const double share = (coordinate - from[i - 1]) / (from[i] - from[i - 1]);
  return to[i - 1] + share * (to[i] - to[i - 1]);
}

PlanVariation::PlanVariation(WorldPlan& plan, int plan_seed)
    : plan_(plan), random_(static_cast<std::uint64_t>(plan_seed), {kPlanStream}) {}

RoomPlan& PlanVariation::roomNamed(const std::string& name) {
  return *std::find_if(plan_.rooms.begin(), plan_.rooms.end(), [&](const RoomPlan& r) { return r.name == name; });
}

bool PlanVariation::has(const std::string& room) const {
  return std::any_of(plan_.rooms.begin(), plan_.rooms.end(), [&](const RoomPlan& r) { return r.name == room; });
}

void PlanVariation::removeOpeningsWithoutRooms() {
  auto& openings = plan_.openings;
  openings.erase(std::remove_if(openings.begin(), openings.end(),
                                [&](const OpeningPlan& opening) {
                                  return !has(opening.rooms[0]) ||
                                         (opening.rooms[1] != "outside" && !has(opening.rooms[1]));
                                }),
                 openings.end());
}

void PlanVariation::maybeLeaveOut(const std::string& room, double probability) {
  if (!random_.chance(probability)) return;
  auto& rooms = plan_.rooms;
  rooms.erase(std::remove_if(rooms.begin(), rooms.end(), [&](const RoomPlan& r) { return r.name == room; }),
              rooms.end());
  removeOpeningsWithoutRooms();
}

void PlanVariation::cutOffBeyond(double x) {
  auto& rooms = plan_.rooms;
  rooms.erase(std::remove_if(rooms.begin(), rooms.end(),
                             [&](const RoomPlan& r) { return boundsOf(r.outline).low.x() > x - kSameLine; }),
              rooms.end());
  for (RoomPlan& room : rooms) {
    for (Vector2d& corner : room.outline) corner.x() = std::min(corner.x(), x);
  }
  auto& openings = plan_.openings;
  openings.erase(std::remove_if(openings.begin(), openings.end(),
                                [&](const OpeningPlan& o) { return o.x + o.width / 2 > x - kSameLine; }),
                 openings.end());
  removeOpeningsWithoutRooms();
}

void PlanVariation::maybeReverseRow(const std::vector<std::string>& rooms, double middle_x) {
  if (!random_.chance(0.5)) return;
  const auto reverse = [&](double x) { return 2 * middle_x - x; };
  for (const std::string& name : rooms) {
    if (!has(name)) continue;
    RoomPlan& room = roomNamed(name);
    const Bounds bounds = boundsOf(room.outline);
    room.outline = rectangle(Vector2d(reverse(bounds.high.x()), bounds.low.y()),
                             Vector2d(reverse(bounds.low.x()), bounds.high.y()));
  }
  for (OpeningPlan& opening : plan_.openings) {
    if (std::find(rooms.begin(), rooms.end(), opening.rooms[0]) != rooms.end()) opening.x = reverse(opening.x);
  }
}

PlanVariation::Axis PlanVariation::drawAxis(int axis) {
  struct Span {
    double low, high, factor;
    bool contains(double middle) const { return middle > low && middle < high; }
  };
  Axis result;
  std::vector<Span> corridors, walls;
  for (const RoomPlan& room : plan_.rooms) {
    const Bounds bounds = boundsOf(room.outline);
    const double low = bounds.low[axis], high = bounds.high[axis];
    for (const double line : {low, high}) result.from.push_back(line);
    if (isNarrowAlong(room, axis))
      corridors.push_back({low, high, random_.uniform(kNarrowestCorridor, kWidestCorridor) / (high - low)});
    for (const RoomPlan& other : plan_.rooms) {
      const double next = boundsOf(other.outline).low[axis];
      if (next > high + kSameLine && next < high + kNominalWall + kSameLine)
        walls.push_back({high, next, wall_factor_});
    }
  }
  auto& from = result.from;
  std::sort(from.begin(), from.end());
  from.erase(std::unique(from.begin(), from.end(), [](double a, double b) { return b - a < kSameLine; }), from.end());
  const double common = random_.uniform(kSmallestFactor, kLargestFactor);
  result.to.push_back(0);
  for (std::size_t i = 1; i < from.size(); ++i) {
    const double middle = (from[i - 1] + from[i]) / 2;
    double factor = (common + random_.uniform(kSmallestFactor, kLargestFactor)) / 2;
    for (const auto* spans : {&walls, &corridors}) {
      for (const Span& span : *spans) {
        if (span.contains(middle)) factor = span.factor;
      }
    }
    result.to.push_back(rounded(result.to.back() + rounded(factor * (from[i] - from[i - 1]))));
  }
  if (random_.chance(0.5)) {
    const double end = result.to.back();
    for (double& line : result.to) line = rounded(end - line);
  }
  return result;
}

void PlanVariation::redrawHeights() {
  const double height = rounded(random_.uniform(kLowestCeiling, kHighestCeiling));
  for (RoomPlan& room : plan_.rooms)
    room.height = room.height <= kHighestCeiling ? height : rounded(room.height * height / kNominalCeiling);
}

void PlanVariation::redraw() {
  wall_factor_ = random_.uniform(kThinnestWall, kThickestWall) / kNominalWall;
  const std::array<Axis, 2> axes{drawAxis(0), drawAxis(1)};
  const auto move = [&](const Vector2d& p) { return Vector2d(axes[0].at(p.x()), axes[1].at(p.y())); };
  for (RoomPlan& room : plan_.rooms) {
    const Vector2d a = move(room.outline[0]), b = move(room.outline[2]);
    room.outline = rectangle(a.cwiseMin(b), a.cwiseMax(b));
  }
  for (OpeningPlan& opening : plan_.openings) {
    const Vector2d at = move({opening.x, opening.y});
    opening.x = at.x();
    opening.y = at.y();
  }
  redrawHeights();
  redrawOpeningPlaces(plan_, random_);
}

}  // namespace omnimapper::sim
