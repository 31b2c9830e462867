#include "LineFit.h"

#include <Eigen/LU>
#include <cmath>

namespace omnimapper::perception::lines {

namespace {

Line facingAway(double nx, double ny, double distance) {
  return distance < 0 ? Line{-nx, -ny, -distance} : Line{nx, ny, distance};
}

}  // namespace

Line Moments::line() const {
  const double mx = x / w, my = y / w;
  const double sxx = xx / w - mx * mx, syy = yy / w - my * my, sxy = xy / w - mx * my;
  const double difference = sxx - syy, spread = std::sqrt(difference * difference + 4 * sxy * sxy);
  // Direction of the larger spread: half the angle of (difference, 2 sxy), in the form without cancellation.
  double tx = difference >= 0 ? spread + difference : 2 * sxy;
  double ty = difference >= 0 ? 2 * sxy : spread - difference;
  const double length = std::sqrt(tx * tx + ty * ty);
  if (length > 0) {
    tx /= length;
    ty /= length;
  } else {
    const double away = std::hypot(mx, my);
    tx = away > 0 ? -my / away : 0;
    ty = away > 0 ? mx / away : 1;
  }
  return facingAway(-ty, tx, tx * my - ty * mx);
}

Line throughPoints(const ScanPoints& points, int i, int j) {
  const double tx = points.x[j] - points.x[i], ty = points.y[j] - points.y[i];
  const double length = std::sqrt(tx * tx + ty * ty);
  if (!(length > 0)) return {points.ux[i], points.uy[i], points.range[i]};
  const double nx = -ty / length, ny = tx / length;
  return facingAway(nx, ny, nx * points.x[i] + ny * points.y[i]);
}

Fit fit(const ScanPoints& points, const Stretch& stretch, double gate) {
  Fit result;
  result.line = stretch.line;
  const double limit = gate * gate;
  // Inliers and weights depend on the line. Two rounds suffice: the second one changes far less than the noise.
  for (int round = 0; round < 2; ++round) {
    Moments moments;
    result.inliers = 0;
    for (int i = stretch.first; i <= stretch.last; ++i) {
      const double off = points.offset(i, result.line), variance = points.variance(i, result.line);
      if (off * off > limit * variance) continue;
      moments.add(points.x[i], points.y[i], 1 / variance);
      if (result.inliers++ == 0) result.first = i;
      result.last = i;
    }
    if (result.inliers < 2) {
      result.inliers = 0;
      return result;
    }
    result.line = moments.line();
  }
  // The residual n . p - distance changes by (t . p) with the angle and by -1 with the distance.
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  double squares = 0;
  int counted = 0;
  for (int i = result.first; i <= result.last; ++i) {
    const double off = points.offset(i, result.line), variance = points.variance(i, result.line);
    if (off * off > limit * variance) continue;
    const double along = result.line.nx * points.y[i] - result.line.ny * points.x[i];
    information(0, 0) += along * along / variance;
    information(0, 1) -= along / variance;
    information(1, 1) += 1 / variance;
    squares += off * off;
    ++counted;
  }
  information(1, 0) = information(0, 1);
  if (counted < 2) {
    result.inliers = 0;
    return result;
  }
  result.covariance = information.inverse();
  result.inliers = counted;
  result.rms = std::sqrt(squares / counted);
  return result;
}

}  // namespace omnimapper::perception::lines
