#include "SurfacePlan.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace omnimapper::eval {

namespace {

using Eigen::Vector2d;

constexpr double kWidth = 1200, kHeight = 900;  // [px]

bool isUpright(const surfaces::Surface& surface) {
  return std::abs(surface.plane.normal.z()) < 0.5;
}

std::vector<std::vector<Vector2d>> fromAbove(const surfaces::Surface& surface) {
  std::vector<std::vector<Vector2d>> polylines;
  for (const auto& part : surface.parts) {
    if (part.outline.empty()) continue;
    if (!isUpright(surface)) {
      auto& polyline = polylines.emplace_back();
      for (const auto& corner : part.outline) polyline.push_back(corner.head<2>());
      polyline.push_back(part.outline.front().head<2>());
      continue;
    }
    const Vector2d along(-surface.plane.normal.y(), surface.plane.normal.x());
    const auto [low, high] =
        std::minmax_element(part.outline.begin(), part.outline.end(), [&](const auto& a, const auto& b) {
          return along.dot(a.template head<2>()) < along.dot(b.template head<2>());
        });
    polylines.push_back({low->head<2>(), high->head<2>()});
  }
  return polylines;
}

draw::Axes axesAround(const std::vector<const surfaces::SurfaceSet*>& sets) {
  Vector2d low = Vector2d::Constant(1e300), high = -low;
  for (const auto* set : sets) {
    for (const auto& surface : set->surfaces) {
      for (const auto& corner : cornersOf(surface)) {
        low = low.cwiseMin(corner.head<2>());
        high = high.cwiseMax(corner.head<2>());
      }
    }
  }
  if (!(low.x() < high.x())) low = {0, 0}, high = {1, 1};
  return draw::Axes::withEqualScale({60, 60}, {kWidth - 80, kHeight - 110}, low, high);
}

}  // namespace

SurfacePlan::SurfacePlan(std::ostream& out, const std::string& title,
                         const std::vector<const surfaces::SurfaceSet*>& sets)
    : svg_(out, kWidth, kHeight), axes_(axesAround(sets)) {
  svg_.box({0, 0}, {kWidth, kHeight}, "#ffffff");
  axes_.draw(svg_, "x [m]", "y [m]");
  svg_.text({60, 20}, title, draw::Svg::Anchor::start, 16);
}

void SurfacePlan::addLegend(const std::string& colour, const std::string& text, double width) {
  constexpr double kY = 38;
  svg_.line({legend_x_, kY}, {legend_x_ + 26, kY}, colour, 4);
  svg_.text({legend_x_ + 32, kY + 4}, text, draw::Svg::Anchor::start);
  legend_x_ += width;
}

void SurfacePlan::draw(const surfaces::Surface& surface, const std::string& colour, double pen) {
  for (const auto& polyline : fromAbove(surface)) {
    std::vector<Vector2d> pixels;
    for (const auto& point : polyline) pixels.push_back(axes_.pixel(point));
    svg_.polyline(pixels, colour, isUpright(surface) ? pen : pen / 2);
  }
}

void SurfacePlan::draw(const surfaces::CellGrid& cells, const std::string& colour) {
  std::set<std::tuple<long, long, long, long>> drawn;  // many rows of an upright surface give the same line
  for (int row = 0; row < cells.rows(); ++row) {
    for (int begin = 0; begin < cells.columns(); ++begin) {
      if (!cells.isSet({begin, row})) continue;
      int end = begin;
      while (end + 1 < cells.columns() && cells.isSet({end + 1, row})) ++end;
      const Vector2d half = cells.u().head<2>() * cells.cell() / 2;
      const Vector2d from = axes_.pixel(cells.middleOf({begin, row}).head<2>() - half);
      const Vector2d to = axes_.pixel(cells.middleOf({end, row}).head<2>() + half);
      const auto is_new =
          drawn.emplace(std::lround(from.x()), std::lround(from.y()), std::lround(to.x()), std::lround(to.y()));
      if (is_new.second) svg_.line(from, to, colour, 1.5);
      begin = end;
    }
  }
}

}  // namespace omnimapper::eval
