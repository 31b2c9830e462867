#pragma once

#include <cmath>

namespace omnimapper::perception::planes {

/// A plane in image coordinates: 1/z = a u + b v + c [1/m], with u and v [px] counted from the principal point.
struct ImagePlane {
  double a = 0, b = 0, c = 0;
  double at(double u, double v) const { return a * u + b * v + c; }
};

struct ImagePlaneFit {
  ImagePlane plane;
  double squares = 0;       ///< sum of squared residuals [1/m^2]
  bool determined = false;  ///< false if the pixels are collinear or fewer than three
};

/// Sums over pixels at (u, v) with the inverse depth q, from which a plane is fitted by least squares. The moments of a
/// union are the sum of those of its parts.
struct PlaneMoments {
  double n = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0, q = 0, uq = 0, vq = 0, qq = 0;

  PlaneMoments& operator+=(const PlaneMoments& o) {
    n += o.n, u += o.u, v += o.v, uu += o.uu, uv += o.uv, vv += o.vv, q += o.q, uq += o.uq, vq += o.vq, qq += o.qq;
    return *this;
  }

  /// Moments of the same pixels about another origin, where each (u, v, q) is larger by (du, dv, dq).
  PlaneMoments shifted(double du, double dv, double dq) const {
    PlaneMoments s;
    s.n = n;
    s.u = u + n * du;
    s.v = v + n * dv;
    s.q = q + n * dq;
    s.uu = uu + 2 * du * u + n * du * du;
    s.vv = vv + 2 * dv * v + n * dv * dv;
    s.uv = uv + du * v + dv * u + n * du * dv;
    s.uq = uq + du * q + dq * u + n * du * dq;
    s.vq = vq + dv * q + dq * v + n * dv * dq;
    s.qq = qq + 2 * dq * q + n * dq * dq;
    return s;
  }

  /// Fits a plane by least squares. If it is not determined, its slopes are 0.
  ImagePlaneFit fit() const {
    if (n < 1) return {};
    const double mu = u / n, mv = v / n, mq = q / n;
    const double suu = uu - mu * u, suv = uv - mu * v, svv = vv - mv * v;
    const double suq = uq - mu * q, svq = vq - mv * q, sqq = qq - mq * q;
    const double determinant = suu * svv - suv * suv;
    ImagePlane plane;
    const bool determined = determinant > 1e-9 * suu * svv;
    if (determined) {
      plane.a = (suq * svv - svq * suv) / determinant;
      plane.b = (svq * suu - suq * suv) / determinant;
    }
    plane.c = mq - plane.a * mu - plane.b * mv;
    return {plane, std::fmax(0.0, sqq - plane.a * suq - plane.b * svq), determined};
  }

  /// Sum of squared residuals from any plane [1/m^2].
  double squaresFrom(const ImagePlane& p) const {
    const double fitted = p.a * (p.a * uu + 2 * (p.b * uv + p.c * u)) + p.b * (p.b * vv + 2 * p.c * v) + p.c * p.c * n;
    return std::fmax(0.0, qq - 2 * (p.a * uq + p.b * vq + p.c * q) + fitted);
  }
};

}  // namespace omnimapper::perception::planes
