#pragma once

#include <omnimapper/perception/ClusterComparator.h>
#include <omnimapper/perception/Normals.h>

#include <cmath>

namespace omnimapper::perception {

/// Comparator: neighbours close together in space, unless the boundary between them is concave: objects that touch meet
/// at concave boundaries, and most objects have none themselves. Source of the idea: S. Stein et al., Object
/// partitioning using local convexity, CVPR 2014.
struct ConvexClusterComparator {
  ClusterComparator cluster;
  const NormalImage& normals;
  int reach = 6;               ///< [px] from a boundary, where the normals are those of its sides
  float max_cosine = 0.9397F;  ///< of the angle between the sides' normals: 20 deg

  bool valid(int pixel) const { return cluster.valid(pixel); }

  bool similar(int a, int b) const { return cluster.similar(a, b) && !isConcave(a, b); }

 private:
  struct Vector {
    float x, y, z;
    float dot(const Vector& v) const { return x * v.x + y * v.y + z * v.z; }
    Vector operator-(const Vector& v) const { return {x - v.x, y - v.y, z - v.z}; }
    Vector operator*(float s) const { return {s * x, s * y, s * z}; }
  };
  Vector point(int pixel) const {
    const auto i = static_cast<std::size_t>(pixel);
    return {cluster.points.x[i], cluster.points.y[i], cluster.points.z[i]};
  }
  Vector normal(int pixel) const {
    const auto i = static_cast<std::size_t>(pixel);
    return {normals.x()[i], normals.y()[i], normals.z()[i]};
  }
  /// Vector from `from`, along the surface with the normal `surface` there, to the ray through `to`. Its direction does
  /// not depend on the two depths, so that their noise does not matter.
  static Vector step(const Vector& from, const Vector& surface, const Vector& to) {
    return to * (surface.dot(from) / surface.dot(to)) - from;
  }

  // The pixel `reach` steps beyond `to`, coming from its neighbour `from`, or the last one before the image's border.
  int beyond(int from, int to) const {
    const int step = to - from, width = cluster.points.width;
    const int row = to / width, column = to % width;
    const int room = step == 1    ? width - 1 - column
                     : step == -1 ? column
                     : step > 0   ? cluster.points.height - 1 - row
                                  : row;
    return to + step * (reach < room ? reach : room);
  }

  // Whether the normals of the two sides point towards each other. NaN, where nothing was measured, fails the
  // comparisons.
  bool isConcave(int a, int b) const {
    const int before = beyond(b, a), behind = beyond(a, b);
    const Vector na = normal(before), nb = normal(behind);
    if (!(na.dot(nb) < max_cosine)) return false;
    const Vector pa = point(before), pb = point(behind), between = step(pa, na, pb) - step(pb, nb, pa);
    return (nb - na).dot(between) < 0;
  }
};

extern template Components connectComponents(int, int, const ConvexClusterComparator&);

}  // namespace omnimapper::perception
