#include "LinePartners.h"

#include <omnimapper/matching/ScanMatcher.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace omnimapper::matching {

namespace {
// A reference point without a line holds a point of the scan from all sides, but by little: it is clutter, or an edge
// that the next beam passes.
constexpr double kPointWeight = 0.1;
// Normals are good to some 4 degrees: a direction that gets less than its square of all information gets noise.
constexpr double kNoiseShare = 0.005;
}  // namespace

double LinePartners::wallDistance() const {
  return weight > 0 ? std::sqrt(squared_distance / weight) : 0;
}

LinePartners findPartners(const PointIndex& reference, const PlanarScan& scan, const mrpt::math::TPose2D& pose,
                          double max_distance, double loss_scale) {
  LinePartners partners;
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  const auto limit = static_cast<float>(max_distance);
  const double scale = 1 / (loss_scale * loss_scale);
  const auto add = [&](double distance, double weight, double nx, double ny, const Eigen::Vector2f& p) {
    const Eigen::Vector3d row(c * nx + s * ny, -s * nx + c * ny,
                              p.x() * (-s * nx + c * ny) - p.y() * (c * nx + s * ny));
    partners.information += weight * row * row.transpose();
    partners.gradient += weight * distance * row;
    partners.squared_radius += weight * row.z() * row.z();
  };
  for (const auto& p : scan.points) {
    const double x = pose.x + c * p.x() - s * p.y(), y = pose.y + s * p.x() + c * p.y();
    const int nearest = reference.nearest(static_cast<float>(x), static_cast<float>(y), limit);
    if (nearest == PointIndex::kNone) continue;
    ++partners.near;
    const auto& q = reference.points()[nearest];
    const auto& n = reference.normals()[nearest];
    const double dx = x - q.x(), dy = y - q.y();
    if (n.isZero()) {
      const double weight = kPointWeight / (1 + (dx * dx + dy * dy) * scale);
      add(dx, weight, 1, 0, p);
      add(dy, weight, 0, 1, p);
      continue;
    }
    const double across = n.x() * dx + n.y() * dy;
    const double weight = 1 / (1 + across * across * scale);
    add(across, weight, n.x(), n.y(), p);
    partners.squared_distance += weight * across * across;
    partners.weight += weight;
  }
  return partners;
}

// Yaw counts by the lever it moves the points with, so that all three are metres.
FixedDirections::FixedDirections(const LinePartners& partners) {
  const double total = partners.information.topLeftCorner<2, 2>().trace();
  if (!(total > 0)) {
    basis_.setIdentity();
    fixed_.setZero();
    return;
  }
  const double lever = std::max(0.5, std::sqrt(partners.squared_radius / total));
  const Eigen::Vector3d scale(1, 1, 1 / lever);
  const Eigen::Matrix3d scaled = scale.asDiagonal() * partners.information * scale.asDiagonal();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(scaled);
  basis_ = scale.asDiagonal() * eigen.eigenvectors();
  for (int i = 0; i < 3; ++i) {
    const double value = eigen.eigenvalues()[i];
    const bool fixed = value > kNoiseShare * total && value > 1e-6;
    fixed_[i] = fixed ? value : 0;
    count_ += fixed;
  }
}

Eigen::Vector3d FixedDirections::step(const Eigen::Vector3d& gradient, const Eigen::Matrix3d& guess_information,
                                      const Eigen::Vector3d& from_guess) const {
  constexpr double kNothing = 1e-9;
  Eigen::Vector3d slope = basis_.transpose() * gradient;
  for (int i = 0; i < 3; ++i) {
    if (fixed_[i] == 0) slope[i] = 0;
  }
  slope += basis_.transpose() * (guess_information * from_guess);
  Eigen::Matrix3d information = basis_.transpose() * guess_information * basis_;
  information.diagonal() += fixed_ + Eigen::Vector3d::Constant(kNothing);
  return -basis_ * information.ldlt().solve(slope);
}

Eigen::Matrix3d FixedDirections::covariance() const {
  Eigen::Vector3d variance;
  for (int i = 0; i < 3; ++i) variance[i] = fixed_[i] > 0 ? 1 / fixed_[i] : ScanMatch::kOpen;
  return basis_ * variance.asDiagonal() * basis_.transpose();
}

}  // namespace omnimapper::matching
