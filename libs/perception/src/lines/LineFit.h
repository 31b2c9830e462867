#pragma once

#include <Eigen/Core>

#include "ScanPoints.h"

namespace omnimapper::perception::lines {

/// Sums over weighted points, from which the line nearest to them follows at once.
struct Moments {
  double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void add(double px, double py, double weight = 1) {
    w += weight;
    x += weight * px;
    y += weight * py;
    xx += weight * px * px;
    xy += weight * px * py;
    yy += weight * py * py;
  }
  Moments minus(const Moments& other) const {
    return {w - other.w, x - other.x, y - other.y, xx - other.xx, xy - other.xy, yy - other.yy};
  }
  Moments plus(const Moments& other) const {
    return {w + other.w, x + other.x, y + other.y, xx + other.xx, xy + other.xy, yy + other.yy};
  }
  /// Total least squares. Of a single point: the line through it square to its beam.
  Line line() const;
};

Line throughPoints(const ScanPoints& points, int i, int j);

/// Weighted total least squares with the deviation that each point has across the line.
struct Fit {
  Line line;
  Eigen::Matrix2d covariance;  ///< of the normal's angle [rad] and the distance [m]
  int inliers = 0;
  int first = 0, last = 0;  ///< points that are inliers at the ends
  double rms = 0;           ///< [m]
};
/// Of those points of the stretch that are within `gate` deviations of its line. Fewer than two: inliers = 0.
Fit fit(const ScanPoints& points, const Stretch& stretch, double gate);

}  // namespace omnimapper::perception::lines
