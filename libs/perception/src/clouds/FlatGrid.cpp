#include "FlatGrid.h"

#include <omnimapper/geometry/PlaneTangent.h>

#include <algorithm>
#include <cmath>

#include "../ConvexHull.h"
#include "../planes/Outlines.h"

namespace omnimapper::perception::clouds {

namespace {

constexpr int kMostCells = 1000;  // along a side of the grid
constexpr double kTolerance = 1;  // [cell] tolerance of a concave outline's corners
constexpr int kLeastHole = 4;     // [cell] smaller holes are not outlined

Eigen::Vector3d onPlane(const FlatGrid& grid, int member, const geometry::Plane3& plane) {
  const Eigen::Vector3d p = grid.point(member);
  return p - geometry::signedDistance(plane, p) * plane.normal;
}

// The cells of one component, with a border of one empty cell.
struct Window {
  int left, top, width, height;
  std::vector<std::uint16_t> labels;
};

Window windowOf(const Components& components, int component) {
  int left = components.width, right = 0, top = components.height, bottom = 0;
  for (const PixelRun& run : components.runs) {
    if (run.component != component) continue;
    left = std::min(left, run.begin);
    right = std::max(right, run.end);
    top = std::min(top, run.row);
    bottom = std::max(bottom, run.row + 1);
  }
  Window window{left - 1, top - 1, right - left + 2, bottom - top + 2, {}};
  window.labels.resize(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height), 0);
  for (const PixelRun& run : components.runs) {
    if (run.component != component) continue;
    const auto row = window.labels.begin() + static_cast<std::ptrdiff_t>(run.row - window.top) * window.width;
    std::fill(row + run.begin - window.left, row + run.end - window.left, std::uint16_t{1});
  }
  return window;
}

/// The point nearest to each corner of a window's cells.
class CornerPoints {
 public:
  CornerPoints(const FlatGrid& grid, const Window& window, const std::vector<int>& members)
      : stride_(window.width + 1),
        nearest_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(window.height + 1)) {
    for (const int member : members) {
      const Eigen::Vector2d in_window = grid.at(member) - Eigen::Vector2d(window.left, window.top);
      for (const int x : {0, 1}) {
        for (const int y : {0, 1}) {
          const Eigen::Vector2i corner = in_window.cast<int>() + Eigen::Vector2i(x, y);
          const double distance = (in_window - corner.cast<double>()).squaredNorm();
          Nearest& nearest = nearest_[index(corner.x(), corner.y())];
          if (distance < nearest.distance) nearest = {member, distance};
        }
      }
    }
  }

  int at(const PixelCorner& corner) const { return nearest_[index(corner.x, corner.y)].member; }

 private:
  struct Nearest {
    int member = FlatGrid::kNone;
    double distance = 3;  // [cell^2] larger than any real one
  };
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * stride_ + x); }

  int stride_;
  std::vector<Nearest> nearest_;
};

void outlineConcave(const FlatGrid& grid, const Components& components, int component, const std::vector<int>& members,
                    CloudPlane& plane) {
  const Window window = windowOf(components, component);
  std::vector<PixelRun> runs;
  for (const PixelRun& run : components.runs) {
    if (run.component == component)
      runs.push_back({run.row - window.top, run.begin - window.left, run.end - window.left, 0});
  }
  const CornerPoints corner_points(grid, window, members);
  for (const auto& line : planes::traceOutlines(window.labels, window.width, window.height, runs, kLeastHole)) {
    geometry::Polygon3 polygon;
    int last = FlatGrid::kNone;
    for (const std::size_t i : planes::cornersNeeded(line.corners, kTolerance)) {
      const int member = corner_points.at(line.corners[i]);
      if (member != last) polygon.vertices.push_back(onPlane(grid, member, plane.plane_in_sensor));
      last = member;
    }
    (line.area > 0 ? plane.outline : plane.holes.emplace_back()) = std::move(polygon);
  }
}

void outlineConvex(const FlatGrid& grid, const std::vector<int>& members, CloudPlane& plane) {
  const geometry::Plane3& in_sensor = plane.plane_in_sensor;
  const auto basis = geometry::tangentBasis(in_sensor.normal);
  std::vector<Eigen::Vector2d> points;
  points.reserve(members.size());
  for (const int member : members) points.emplace_back(basis.transpose() * grid.point(member));
  for (const auto& corner : convexHull(std::move(points)))
    plane.outline.vertices.emplace_back(basis * corner - in_sensor.distance * in_sensor.normal);
}

// Orients the outline counter-clockwise against the normal, and the holes clockwise.
void orient(CloudPlane& plane) {
  if (areaVector(plane.outline).dot(plane.plane_in_sensor.normal) >= 0) return;
  std::reverse(plane.outline.vertices.begin(), plane.outline.vertices.end());
  for (auto& hole : plane.holes) std::reverse(hole.vertices.begin(), hole.vertices.end());
}

}  // namespace

FlatGrid::FlatGrid(const LoosePoints& points, const std::vector<int>& members, const geometry::Plane3& plane,
                   double cell)
    : points_(points), basis_(geometry::tangentBasis(plane.normal)) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e30), high = -low;
  for (const int member : members) {
    const Eigen::Vector2d at = basis_.transpose() * point(member);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  cell_ = std::max(cell, (high - low).maxCoeff() / kMostCells);
  corner_ = low;
  width_ = static_cast<int>((high.x() - low.x()) / cell_) + 1;
  height_ = static_cast<int>((high.y() - low.y()) / cell_) + 1;
  filled_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
  for (const int member : members) filled_[cellOf(member)] = 1;
}

Eigen::Vector2d FlatGrid::at(int point) const {
  return (basis_.transpose() * this->point(point) - corner_) / cell_;
}

int FlatGrid::cellOrNone(int point) const {
  const Eigen::Vector2d place = at(point);
  if (!(place.x() >= 0 && place.y() >= 0 && place.x() < width_ && place.y() < height_)) return kNone;
  return static_cast<int>(place.y()) * width_ + static_cast<int>(place.x());
}

void outline(const FlatGrid& grid, const Components& components, int component, const std::vector<int>& members,
             CloudPlaneOptions::Outline kind, CloudPlane& plane) {
  if (kind == CloudPlaneOptions::Outline::convex) {
    outlineConvex(grid, members, plane);
  } else {
    outlineConcave(grid, components, component, members, plane);
  }
  orient(plane);
}

}  // namespace omnimapper::perception::clouds
