#include "omnimapper/surfaces/ThingsOfFaces.h"

#include <omnimapper/geometry/ConvexPolygon2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numeric>
#include <optional>

#include "SurfaceCells.h"
#include "Touching.h"

namespace omnimapper::surfaces {

namespace {

using Class = SurfaceClass;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// A surface that may be a face of a thing.
struct Face {
  const Surface* surface;
  SurfaceFacts facts;
  double height() const { return (facts.bottom + facts.top) / 2; }  ///< of a level face
  bool isUpright() const { return facts.lie == Lie::upright; }
  bool isLevel() const { return facts.lie == Lie::up; }
};

bool classesAgree(Class a, Class b) {
  if (a == b) return true;
  const Class other = a == Class::cabinet ? b : a;
  const bool is_side = a == Class::cabinet || b == Class::cabinet;
  return is_side && (other == Class::table || other == Class::counter || other == Class::shelf);
}

bool isSoft(const Face& face) {
  return face.surface->is == Class::seat || face.surface->is == Class::bed;
}

bool touch(const Face& a, const Face& b, double gap) {
  return overlapInHeight(a.facts, b.facts) && geometry::distance(a.facts.plan, b.facts.plan) <= gap;
}

// Sides that meet at a corner. Those of a box lead away from the viewer, and those of a sofa's back and arms, or of a
// shelf and its boards, towards the viewer.
bool areSides(const Face& a, const Face& b) {
  if (!meetAtEnd(*a.surface, a.facts, *b.surface, b.facts) || !meetAtEnd(*b.surface, b.facts, *a.surface, a.facts))
    return false;
  const bool is_outer = liesBehind(*a.surface, b.facts) && liesBehind(*b.surface, a.facts);
  return is_outer || isSoft(a) || a.surface->is == Class::shelf;
}

// Pieces of one side.
bool arePiecesOfSide(const Face& a, const Face& b) {
  constexpr double kAlong = 0.98, kOff = 0.06;  // cosine of the angle between normals, [m]
  return a.surface->is == b.surface->is && a.surface->plane.normal.dot(b.surface->plane.normal) > kAlong &&
         std::abs(signedDistance(a.surface->plane, b.facts.middle)) < kOff;
}

// A level face and an upright one at its edge: a side below it, the back or an arm of a seat above it, or a box under a
// table top.
bool areTopAndSide(const Face& level, const Face& side) {
  const double from_top = side.facts.top - level.height(), from_bottom = side.facts.bottom - level.height();
  if (std::abs(from_top) <= kTouch) return liesBehind(*side.surface, level.facts) || isSoft(level);
  const bool is_board = level.surface->is == Class::shelf;
  if (from_top > 0) return (isSoft(level) || is_board) && from_bottom <= kTouch;
  constexpr double kBelow = 0.3;  // [m]
  return level.surface->is == Class::table && side.surface->is == Class::cabinet && from_top > -kBelow;
}

// Pieces of one level face, boards of a shelf, or a seat and the arm beside it.
bool areLevelPieces(const Face& a, const Face& b) {
  constexpr double kSame = 0.06, kArm = 0.35, kGap = 0.06;  // [m]
  const double apart = std::abs(a.height() - b.height()), gap = geometry::distance(a.facts.plan, b.facts.plan);
  if (a.surface->is != b.surface->is) return false;
  if (a.surface->is == Class::shelf) return gap <= 0;
  return (apart <= kSame && gap <= kGap) || (a.surface->is == Class::seat && apart <= kArm && gap <= kTouch);
}

bool areOfOneThing(const Face& a, const Face& b) {
  if (!classesAgree(a.surface->is, b.surface->is)) return false;
  if (a.isLevel() && b.isLevel()) return areLevelPieces(a, b);
  if (a.isUpright() && b.isUpright()) return touch(a, b, kTouch) && (areSides(a, b) || arePiecesOfSide(a, b));
  if (a.isLevel() && b.isUpright())
    return geometry::distance(a.facts.plan, b.facts.plan) <= kTouch && areTopAndSide(a, b);
  return a.isUpright() && b.isLevel() && areOfOneThing(b, a);
}

/// The index of the first face of its thing, for each face.
std::vector<std::size_t> firstFaces(const std::vector<Face>& faces) {
  std::vector<std::size_t> first(faces.size());
  std::iota(first.begin(), first.end(), 0);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (first[i] == first[j] || !areOfOneThing(faces[i], faces[j])) continue;
      const auto [low, high] = std::minmax(first[i], first[j]);
      std::replace(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(i + 1), std::size_t{high},
                   std::size_t{low});
    }
  }
  return first;
}

Class classOf(const std::vector<const Face*>& faces) {
  const Face* top = nullptr;
  double top_area = 0;
  std::map<Class, double> areas;
  for (const Face* face : faces) {
    const double area = areaOf(*face->surface);
    areas[face->surface->is] += area;
    if (!face->isLevel() || face->surface->is == Class::cabinet || area <= top_area) continue;
    top = face;
    top_area = area;
  }
  if (top) return top->surface->is;
  const auto less = [](const auto& a, const auto& b) { return a.second < b.second; };
  return std::max_element(areas.begin(), areas.end(), less)->first;
}

struct Rectangle {
  double direction = 0;
  Vector2d low{0, 0}, high{0, 0};  // along the direction and across it
  double area() const { return (high - low).prod(); }
};

Rectangle rectangleAlong(double direction, const std::vector<Vector3d>& cells) {
  const Vector2d along(std::cos(direction), std::sin(direction)), across(-along.y(), along.x());
  const Vector2d on_u = rangeAlong(cells, onFloor(along)), on_v = rangeAlong(cells, onFloor(across));
  return {direction, {on_u.x(), on_v.x()}, {on_u.y(), on_v.y()}};
}

// The direction that most of the length of the upright faces has, up to right angles; none without upright faces.
std::optional<double> directionOfSides(const std::vector<const Face*>& faces) {
  std::complex<double> sum = 0;
  for (const Face* face : faces) {
    if (!face->isUpright()) continue;
    const Vector2d along = alongFloor(face->surface->plane);
    sum += std::polar(face->facts.longer, 4 * std::atan2(along.y(), along.x()));
  }
  if (std::abs(sum) == 0) return std::nullopt;
  return std::arg(sum) / 4;
}

Rectangle rectangleOf(const std::vector<const Face*>& faces, const std::vector<Vector3d>& cells) {
  if (const auto direction = directionOfSides(faces)) return rectangleAlong(*direction, cells);
  constexpr int kDirections = 45;
  Rectangle best = rectangleAlong(0, cells);
  for (int i = 1; i < kDirections; ++i)
    if (const auto other = rectangleAlong(M_PI / 2 * i / kDirections, cells); other.area() < best.area()) best = other;
  return best;
}

Thing thingAround(const std::vector<const Face*>& faces) {
  Thing thing;
  thing.is = classOf(faces);
  std::vector<Vector3d> cells;
  for (const Face* face : faces)
    for (const auto& cell : cellsOf(*face->surface).middles) cells.push_back(cell);
  const Rectangle box = rectangleOf(faces, cells);
  const bool is_along = box.high.x() - box.low.x() >= box.high.y() - box.low.y();
  const double turn = is_along ? box.direction : box.direction + M_PI / 2;
  thing.direction = turn - M_PI * std::floor(turn / M_PI + 0.5);
  thing.length = (box.high - box.low).maxCoeff();
  thing.width = (box.high - box.low).minCoeff();
  thing.middle = Eigen::Rotation2Dd(box.direction) * Vector2d((box.low + box.high) / 2);
  thing.bottom = HUGE_VAL;
  thing.top = -HUGE_VAL;
  for (const Face* face : faces) {
    thing.bottom = std::min(thing.bottom, face->facts.bottom);
    thing.top = std::max(thing.top, face->facts.top);
  }
  return thing;
}

}  // namespace

std::vector<Vector2d> Thing::corners() const {
  const Vector2d along = Vector2d(std::cos(direction), std::sin(direction)) * length / 2,
                 across = Vector2d(-std::sin(direction), std::cos(direction)) * width / 2;
  return {middle - along - across, middle + along - across, middle + along + across, middle - along + across};
}

bool isOfThing(SurfaceClass surface_class) {
  constexpr Class kOfThings[] = {Class::table, Class::counter, Class::shelf,    Class::cabinet,
                                 Class::seat,  Class::bed,     Class::appliance};
  return std::find(std::begin(kOfThings), std::end(kOfThings), surface_class) != std::end(kOfThings);
}

Thing thingOf(const std::vector<Surface>& faces) {
  const auto facts = factsOf(faces, 0);
  std::vector<Face> all;
  for (std::size_t i = 0; i < faces.size(); ++i) all.push_back({&faces[i], facts[i]});
  std::vector<const Face*> pointers;
  for (const Face& face : all) pointers.push_back(&face);
  Thing thing = thingAround(pointers);
  for (std::size_t i = 0; i < faces.size(); ++i) thing.faces.push_back(i);
  return thing;
}

std::vector<Thing> thingsOf(const std::vector<Surface>& surfaces) {
  std::vector<Surface> candidates;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (!isOfThing(surfaces[i].is) || cornersOf(surfaces[i]).empty()) continue;
    candidates.push_back(surfaces[i]);
    indices.push_back(i);
  }
  const auto facts = factsOf(candidates, 0);
  std::vector<Face> faces;
  for (std::size_t i = 0; i < candidates.size(); ++i) faces.push_back({&candidates[i], facts[i]});
  const auto first = firstFaces(faces);
  std::map<std::size_t, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < faces.size(); ++i) groups[first[i]].push_back(i);
  std::vector<Thing> things;
  for (const auto& [begin, group] : groups) {
    std::vector<const Face*> of_thing;
    for (const std::size_t i : group) of_thing.push_back(&faces[i]);
    Thing& thing = things.emplace_back(thingAround(of_thing));
    for (const std::size_t i : group) thing.faces.push_back(indices[i]);
  }
  return things;
}

}  // namespace omnimapper::surfaces
