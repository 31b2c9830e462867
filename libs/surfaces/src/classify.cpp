#include "omnimapper/surfaces/classify.h"

#include <omnimapper/geometry/ConvexPolygon2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

namespace omnimapper::surfaces {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Class = SurfaceClass;

enum class Lie { up, down, upright, leaning };

/// What is measured of a surface. Lengths in metres.
struct Facts {
  Lie lie = Lie::leaning;
  double bottom = 0, top = 0;      // above the floor
  double longer = 0, shorter = 0;  // sides of the least rectangle around it; of an upright one its width and height
  bool is_before_wall = false;     // a surface that faces the same way stands close behind it
  bool is_at_seat = false;         // it touches a level surface at the height of a seat
  bool is_at_bed = false;          // or one of the size of a bed
  Vector2d along{0, 0};            // of an upright one, where it begins and ends along the floor
  Eigen::AlignedBox3d box;
};

Lie lieOf(const geometry::Plane3& plane) {
  constexpr double kLevel = 0.95, kUpright = 0.2;  // of the normal's height
  const double up = plane.normal.z();
  return up > kLevel ? Lie::up : up < -kLevel ? Lie::down : std::abs(up) < kUpright ? Lie::upright : Lie::leaning;
}

Vector2d alongFloor(const geometry::Plane3& plane) {
  return Vector2d(-plane.normal.y(), plane.normal.x()).normalized();
}

// A corner that sticks out, as where a view mixed two surfaces, has little area: between the directions' quantiles lies
// all but one part in thirty of the surface at either end.
constexpr double kOutlying = 1.0 / 30;
Vector2d quantiles(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  const double low = values[static_cast<std::size_t>(kOutlying * last)],
               high = values[static_cast<std::size_t>((1 - kOutlying) * last)];
  const double beyond = (high - low) * kOutlying / (1 - 2 * kOutlying);  // what an even distribution has there
  return {low - beyond, high + beyond};
}

std::vector<Vector3d> cellsOf(const Surface& surface) {
  constexpr double kCell = 0.05, kMostCells = 500;  // [m], along a side
  Eigen::AlignedBox3d box;
  for (const auto& corner : cornersOf(surface)) box.extend(corner);
  auto grid = CellGrid::around(surface.plane, cornersOf(surface), std::max(kCell, box.diagonal().norm() / kMostCells));
  for (const auto& part : surface.parts) grid.fill(part.outline, part.holes);
  std::vector<Vector3d> cells;
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column)
      if (grid.isSet({column, row})) cells.push_back(grid.middleOf({column, row}));
  return cells.empty() ? cornersOf(surface) : cells;
}

Vector2d rangeAlong(const std::vector<Vector3d>& cells, const Vector3d& along) {
  std::vector<double> values;
  for (const auto& cell : cells) values.push_back(along.dot(cell));
  return quantiles(std::move(values));
}

Vector3d onFloor(const Vector2d& direction) {
  return {direction.x(), direction.y(), 0};
}

// Of the least rectangle around it from above, longer side first.
Vector2d leastRectangle(const std::vector<Vector3d>& cells) {
  constexpr int kDirections = 18;
  Vector2d best(1e300, 1e300);
  for (int i = 0; i < kDirections; ++i) {
    const double angle = M_PI / 2 * i / kDirections;
    const Vector2d u(std::cos(angle), std::sin(angle)), v(-u.y(), u.x());
    const Vector2d on_u = rangeAlong(cells, onFloor(u)), on_v = rangeAlong(cells, onFloor(v));
    const Vector2d size(on_u.y() - on_u.x(), on_v.y() - on_v.x());
    if (size.prod() < best.prod()) best = {size.maxCoeff(), size.minCoeff()};
  }
  return best;
}

Facts factsOf(const Surface& surface, double floor) {
  Facts facts;
  facts.lie = lieOf(surface.plane);
  if (cornersOf(surface).empty()) return facts;
  const auto cells = cellsOf(surface);
  for (const auto& cell : cells) facts.box.extend(cell);
  const Vector2d heights = rangeAlong(cells, Vector3d::UnitZ());
  facts.bottom = heights.x() - floor;
  facts.top = heights.y() - floor;
  if (facts.lie == Lie::upright) {
    facts.along = rangeAlong(cells, onFloor(alongFloor(surface.plane)));
    facts.longer = facts.along.y() - facts.along.x();
    facts.shorter = facts.top - facts.bottom;
  } else {
    const Vector2d sides = leastRectangle(cells);
    facts.longer = sides.x();
    facts.shorter = sides.y();
  }
  return facts;
}

// Whether `behind` is a wall, or might be, that continues beside or above a surface that stands close before it.
bool isWallBehind(const Surface& surface, const Facts& facts, const Surface& behind, const Facts& of_behind) {
  constexpr double kNear = 0.12, kFar = 0.95, kBeside = 0.5, kLow = 0.4, kLeastWall = 1;  // [m]
  constexpr double kMuch = 0.8;
  if (of_behind.lie != Lie::upright || behind.plane.normal.dot(surface.plane.normal) < 0.97) return false;
  const double before = signedDistance(behind.plane, facts.box.center());
  if (before < kNear || before > kFar || of_behind.top < facts.top - kLow) return false;
  if (of_behind.longer < std::max(kLeastWall, kMuch * facts.longer)) return false;
  // Both directions along the floor are nearly the same.
  return of_behind.along.x() < facts.along.y() + kBeside && of_behind.along.y() > facts.along.x() - kBeside;
}

bool isLow(const Facts& facts) {
  return facts.lie == Lie::up && facts.bottom > 0.33 && facts.top < 0.68 && facts.shorter > 0.3;
}
bool isBed(const Facts& facts) {
  return isLow(facts) && facts.longer > 1.75 && facts.shorter > 0.75;
}

void addNeighbours(const std::vector<Surface>& surfaces, std::vector<Facts>& all) {
  constexpr double kTouch = 0.12, kHighestSeat = 0.53;  // [m]
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (i == j || all[i].box.isEmpty() || all[j].box.isEmpty()) continue;
      if (all[i].lie == Lie::upright && !all[i].is_before_wall)
        all[i].is_before_wall = isWallBehind(surfaces[i], all[i], surfaces[j], all[j]);
      if (!isLow(all[j]) || all[i].box.exteriorDistance(all[j].box) > kTouch) continue;
      if (isBed(all[j])) {
        all[i].is_at_bed = true;
      } else if (all[j].top < kHighestSeat) {
        all[i].is_at_seat = true;
      }
    }
  }
}

/// A measure within [low, high] is as likely as any; outside it falls like a normal distribution of that sigma.
struct Window {
  double low, high, sigma;
  double logLikelihood(double value) const {
    const double off = std::max({0.0, low - value, value - high}) / sigma;
    return -off * off / 2;
  }
};
constexpr double kAny = 1e6;
constexpr Window kAnything{-kAny, kAny, 1};

/// Log-likelihoods of what stands close behind and touches it.
struct Neighbours {
  double wall = 0, no_wall = 0, seat = 0, no_seat = 0, bed = 0, no_bed = 0;
};

/// One usual form of a class.
struct Form {
  Class is;
  double log_prior;
  Window bottom, top, longer, shorter;
  Neighbours beside = {};
};

// Sizes are those of DIN 18101 (doors) and usual furniture. Tables are deeper than boards and cabinets are.
const std::vector<Form>& levelForms() {
  static const std::vector<Form> all{
      {Class::floor, 0, {-0.15, 0.15, 0.05}, {-0.15, 0.15, 0.05}, kAnything, kAnything},
      {Class::table, 0, {0.66, 0.82, 0.04}, {0.66, 0.82, 0.04}, {0.6, 3.0, 0.2}, {0.55, 1.6, 0.06}},
      {Class::table, -0.7, {0.84, 0.95, 0.03}, {0.84, 0.95, 0.03}, {1.0, 3.0, 0.2}, {0.74, 1.2, 0.04}},
      {Class::table, -1.2, {0.35, 0.5, 0.04}, {0.35, 0.5, 0.04}, {0.8, 1.4, 0.1}, {0.5, 0.8, 0.06}, {0, 0, -1, 0}},
      {Class::counter, 0, {0.85, 0.97, 0.03}, {0.85, 0.97, 0.03}, {1.0, 5.0, 0.2}, {0.5, 0.72, 0.06}},
      {Class::cabinet, -0.3, {0.55, 1.45, 0.05}, {0.55, 1.45, 0.05}, {0.3, 2.2, 0.1}, {0.2, 0.5, 0.05}},
      {Class::appliance, -2, {0.85, 1.1, 0.05}, {0.85, 1.1, 0.05}, {0.5, 0.7, 0.05}, {0.5, 0.7, 0.05}},
      {Class::shelf, -1.5, {0.3, 1.8, 0.1}, {0.3, 1.8, 0.1}, {0.6, 1.3, 0.1}, {0.15, 0.4, 0.03}},
      {Class::seat, 0, {0.38, 0.5, 0.03}, {0.38, 0.5, 0.03}, {0.35, 2.1, 0.2}, {0.3, 0.95, 0.1}},
      {Class::bed, 0, {0.38, 0.65, 0.04}, {0.38, 0.65, 0.04}, {1.85, 2.3, 0.12}, {0.8, 2.2, 0.1}},
  };
  return all;
}

const std::vector<Form>& undersideForms() {
  static const std::vector<Form> all{
      {Class::ceiling, 0, {2.1, kAny, 0.1}, {2.1, kAny, 0.1}, {0.5, kAny, 0.2}, kAnything},
      {Class::cabinet, -0.5, {0.3, 2.0, 0.1}, {0.3, 2.0, 0.1}, kAnything, {0, 0.8, 0.1}},
  };
  return all;
}

// `longer` is the width, `shorter` the height. A camera on a robot sees little of what is above 2 m, and of the walls
// of small rooms less.
const std::vector<Form>& uprightForms() {
  static const std::vector<Form> all{
      {Class::wall, 0, {-kAny, 0.6, 0.3}, {1.7, kAny, 0.15}, {1.1, kAny, 0.15}, {0.8, kAny, 0.2}, {-3, 0}},
      {Class::wall, 0, {-kAny, 0.6, 0.3}, {1.3, kAny, 0.15}, {2.4, kAny, 0.15}, {0.7, kAny, 0.2}, {-1, 0}},
      {Class::wall, -1.2, {-kAny, 0.6, 0.3}, {1.9, kAny, 0.1}, {0.35, 1.1, 0.1}, {1.0, kAny, 0.2}, {-4, 0}},
      {Class::wall, -1.5, {0.6, 2.2, 0.2}, {1.9, kAny, 0.1}, {1.0, kAny, 0.2}, {0.3, kAny, 0.1}, {-3, 0}},
      {Class::door, 0.5, {-kAny, 0.15, 0.1}, {1.55, 2.08, 0.05}, {0.7, 1.05, 0.04}, {1.3, 2.2, 0.1}},
      {Class::door_frame, 0, {-kAny, 0.4, 0.2}, {1.2, 2.15, 0.1}, {0.05, 0.32, 0.04}, {0.9, 2.2, 0.1}},
      {Class::cabinet, 0, {-kAny, 0.35, 0.1}, {0.5, 1.45, 0.1}, {0.25, 2.4, 0.15}, {0.25, 1.4, 0.1}, {0.3, -0.3, -0.3}},
      {Class::cabinet, -0.5, {-kAny, 0.5, 0.1}, {1.4, 2.2, 0.06}, {0.4, 2.2, 0.1}, {0.9, 2.2, 0.2}, {0, -3}},
      {Class::cabinet, -1, {0.9, 1.6, 0.1}, {1.6, 2.3, 0.1}, {0.3, 2.5, 0.2}, {0.3, 0.9, 0.1}, {0, -2}},
      {Class::seat, -0.8, {-kAny, 0.6, 0.1}, {0.5, 1.0, 0.06}, {0.3, 2.2, 0.2}, {0.15, 0.9, 0.1}, {0, 0, 0.7, -2}},
      {Class::bed, 0, {-kAny, 0.55, 0.1}, {0.4, 1.05, 0.04}, {1.3, 2.3, 0.15}, {0.15, 0.9, 0.1}, {0, 0, 0, 0, 0.7, -3}},
  };
  return all;
}

const std::vector<Form>& leaningForms() {
  static const std::vector<Form> all{
      {Class::ramp, -1, {-0.2, 0.1, 0.1}, {0.1, kAny, 0.1}, {1.0, kAny, 0.2}, {0.7, kAny, 0.1}},
  };
  return all;
}

const std::vector<Form>& formsOf(Lie lie) {
  switch (lie) {
    case Lie::up:
      return levelForms();
    case Lie::down:
      return undersideForms();
    case Lie::upright:
      return uprightForms();
    case Lie::leaning:
      break;
  }
  return leaningForms();
}

// The probability of being anything else: a form that has no usual size.
constexpr double kUnknown = -4;

std::string textOf(const Facts& facts, const std::vector<std::pair<double, Class>>& posterior) {
  char text[160];
  if (facts.lie == Lie::upright) {
    std::snprintf(text, sizeof text, "upright from %.2f to %.2f m above the floor, %.2f m wide%s%s", facts.bottom,
                  facts.top, facts.longer, facts.is_before_wall ? ", close before a wall" : "",
                  facts.is_at_bed    ? ", at a bed"
                  : facts.is_at_seat ? ", at a seat"
                                     : "");
  } else {
    std::snprintf(text, sizeof text, "%s, %.2f m above the floor, %.2f by %.2f m",
                  facts.lie == Lie::up     ? "level"
                  : facts.lie == Lie::down ? "level from below"
                                           : "leaning",
                  (facts.bottom + facts.top) / 2, facts.longer, facts.shorter);
  }
  std::string reason = text;
  for (std::size_t i = 0; i < posterior.size() && i < 2 && posterior[i].first >= 0.01; ++i) {
    std::snprintf(text, sizeof text, "%s%s %.2f", i == 0 ? ": " : ", ", toString(posterior[i].second).c_str(),
                  posterior[i].first);
    reason += text;
  }
  return reason;
}

Judgement judge(const Facts& facts) {
  std::map<Class, double> best{{Class::surface, kUnknown}};
  for (const Form& form : formsOf(facts.lie)) {
    const double sum = form.log_prior + form.bottom.logLikelihood(facts.bottom) + form.top.logLikelihood(facts.top) +
                       form.longer.logLikelihood(facts.longer) + form.shorter.logLikelihood(facts.shorter) +
                       (facts.is_before_wall ? form.beside.wall : form.beside.no_wall) +
                       (facts.is_at_seat ? form.beside.seat : form.beside.no_seat) +
                       (facts.is_at_bed ? form.beside.bed : form.beside.no_bed);
    const auto [found, is_new] = best.try_emplace(form.is, sum);
    if (!is_new) found->second = std::max(found->second, sum);
  }
  double whole = 0;
  for (const auto& one : best) whole += std::exp(one.second);
  std::vector<std::pair<double, Class>> posterior;
  for (const auto& [is, sum] : best) posterior.emplace_back(std::exp(sum) / whole, is);
  std::stable_sort(posterior.begin(), posterior.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  return {posterior.front().first >= 0.5 ? posterior.front().second : Class::surface, textOf(facts, posterior)};
}

}  // namespace

std::vector<Judgement> classify(const std::vector<Surface>& surfaces, double floor) {
  std::vector<Facts> all;
  for (const auto& surface : surfaces) all.push_back(factsOf(surface, floor));
  addNeighbours(surfaces, all);
  std::vector<Judgement> judgements;
  for (const auto& facts : all) judgements.push_back(facts.box.isEmpty() ? Judgement{} : judge(facts));
  return judgements;
}

}  // namespace omnimapper::surfaces
