#include "omnimapper/geometry/PolygonUnion.h"

// Coordinates are doubles of metres: no need to be scaled to whole numbers.
#define BOOST_GEOMETRY_NO_ROBUSTNESS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include "omnimapper/geometry/ConvexPolygon2.h"

namespace omnimapper::geometry {

namespace {

namespace bg = boost::geometry;
using Points = std::vector<Eigen::Vector2d>;
using Corner = bg::model::d2::point_xy<double>;
using Area = bg::model::polygon<Corner, false>;  // counter-clockwise, first point again at the end
using Areas = bg::model::multi_polygon<Area>;

constexpr double kStraight = 0.005;  // [m]

Area areaOf(const Points& points) {
  Area area;
  for (const auto& point : points) area.outer().emplace_back(point.x(), point.y());
  bg::correct(area);
  return area;
}

// Without needless corners, and sound: the algorithms of Boost want polygons that do not cross themselves.
Area soundAreaOf(const Points& points) {
  const Area whole = areaOf(points);
  Area simple;
  bg::simplify(whole, simple, kStraight);
  if (bg::is_valid(simple)) return simple;
  return bg::is_valid(whole) ? whole : areaOf(convexHull(points));
}

// What lay in a hole lies within the outline around it then.
Areas withoutHoles(const Areas& areas) {
  Areas all;
  for (const Area& area : areas) {
    Area closed;
    closed.outer() = area.outer();
    Areas together;
    bg::union_(all, closed, together);
    all = std::move(together);
  }
  return all;
}

Points pointsOf(const Area& area) {
  Points points;
  for (const auto& corner : area.outer()) points.emplace_back(corner.x(), corner.y());
  if (!points.empty()) points.pop_back();
  return points;
}

}  // namespace

std::vector<Points> unionOf(const std::vector<Points>& polygons) {
  Areas all;
  for (const auto& polygon : polygons) {
    const Area area = soundAreaOf(polygon);
    if (!(bg::area(area) > 0)) continue;
    Areas together;
    bg::union_(all, area, together);
    all = withoutHoles(together);
  }
  std::vector<Points> outlines;
  for (const Area& area : all) outlines.push_back(pointsOf(area));
  return outlines;
}

double areaOutside(const Points& polygon, const std::vector<Points>& outlines) {
  Areas left{soundAreaOf(polygon)};
  for (const auto& outline : outlines) {
    Areas rest;
    bg::difference(left, areaOf(outline), rest);
    left = std::move(rest);
  }
  return bg::area(left);
}

}  // namespace omnimapper::geometry
