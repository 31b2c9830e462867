#include "GridFloor.h"

#include <vector>

namespace omnimapper::plugins {

namespace {

using mrpt::math::TPoint3Df;
using mrpt::opengl::TTriangle;

void addStripe(const TPoint3Df& low, const TPoint3Df& high, const mrpt::img::TColor& colour,
               std::vector<TTriangle>& triangles) {
  const TPoint3Df right(high.x, low.y, low.z), left(low.x, high.y, low.z);
  for (TTriangle triangle : {TTriangle(low, right, high), TTriangle(low, high, left)}) {
    for (auto& vertex : triangle.vertices) vertex.setColor(colour);
    triangles.push_back(triangle);
  }
}

}  // namespace

mrpt::opengl::CSetOfTriangles::Ptr gridFloor(const derived::ScanGrid& grid, double z) {
  const mrpt::img::TColor free(255, 255, 255), wall(24, 33, 47);
  const auto at = [&](int column, int row) {
    return TPoint3Df(static_cast<float>(grid.min_x + column * grid.resolution),
                     static_cast<float>(grid.min_y + row * grid.resolution), static_cast<float>(z));
  };
  std::vector<TTriangle> triangles;
  for (int row = 0; row < grid.rows; ++row) {
    for (int begin = 0, end; begin < grid.columns; begin = end) {
      const derived::Cell cell = grid.at(begin, row);
      for (end = begin + 1; end < grid.columns && grid.at(end, row) == cell;) ++end;
      if (cell != derived::Cell::unknown)
        addStripe(at(begin, row), at(end, row + 1), cell == derived::Cell::free ? free : wall, triangles);
    }
  }
  auto floor = mrpt::opengl::CSetOfTriangles::Create();
  floor->insertTriangles(triangles.begin(), triangles.end());
  floor->enableLight(false);
  floor->setName("grid");
  return floor;
}

}  // namespace omnimapper::plugins
