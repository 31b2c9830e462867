#pragma once

#include <Eigen/Core>

#include "ScanPoints.h"

namespace omnimapper::perception::lines {

/// Sums over weighted points, from which the best line is computed in closed form.
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
  /// The line by total least squares; for a single point, the line through it at right angles to its beam.
  Line line() const;
};

Line throughPoints(const ScanPoints& points, int i, int j);

/// A line by total least squares, weighted by the inverse variance of each point across the line.
struct Fit {
  Line line;
  Eigen::Matrix2d covariance;  ///< of the normal's angle [rad] and the distance [m]
  int inliers = 0;
  int first = 0, last = 0;  ///< the first and the last inlier
  double rms = 0;           ///< [m]
};
/// Fits the points of the stretch that are within `gate` standard deviations of its line. With fewer than two of them
/// inliers = 0.
Fit fit(const ScanPoints& points, const Stretch& stretch, double gate);

}  // namespace omnimapper::perception::lines
