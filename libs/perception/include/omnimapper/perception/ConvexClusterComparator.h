#pragma once

#include <omnimapper/perception/ClusterComparator.h>
#include <omnimapper/perception/Normals.h>

#include <cmath>

namespace omnimapper::perception {

/// Comparator for connectComponents(): joins neighbours that are close together in space, unless the boundary between
/// them is concave. Objects that touch meet at a concave boundary, while most objects have no concave boundaries of
/// their own. Source of the idea: S. Stein et al., Object partitioning using local convexity, CVPR 2014.
struct ConvexClusterComparator {
  ClusterComparator cluster;
  const NormalImage& normals;
  int reach = 6;               ///< [px] distance from a boundary at which the normals of its two sides are taken
  float max_cosine = 0.9397F;  ///< cosine of 20 deg, the smallest angle between the normals at a concave boundary

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
  /// The vector from the point `from` to the ray through `to`, within the plane through `from` with the normal
  /// `surface`. Its direction does not depend on the depths of the two points, so that the noise of the depths does not
  /// matter.
  static Vector step(const Vector& from, const Vector& surface, const Vector& to) {
    return to * (surface.dot(from) / surface.dot(to)) - from;
  }

  // The pixel `reach` steps beyond `to`, coming from its neighbour `from`, or the last pixel before the image's border.
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
