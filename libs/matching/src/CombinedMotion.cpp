#include "CombinedMotion.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>
#include <omnimapper/geometry/SymmetricEigen.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {

Eigen::Vector3d vectorOf(const TPose2D& motion) {
  return {motion.x, motion.y, mrpt::math::wrapToPi(motion.phi)};
}

}  // namespace

Eigen::Matrix3d covarianceOf(const ScanMatch& match) {
  constexpr double kLeast = 0.02;  // [m] of a point, however well the others fit
  return mrpt::square(std::max(kLeast, match.point_sigma)) * match.unit_covariance;
}

bool isDetermined(const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix2d position = covariance.topLeftCorner<2, 2>();
  const double largest = 0.5 * position.trace() + std::hypot(0.5 * (position(0, 0) - position(1, 1)), position(0, 1));
  return largest < mrpt::square(ScanTracker::kDetermined) &&
         covariance(2, 2) < mrpt::square(ScanTracker::kDeterminedYaw);
}

namespace {

// Squared differences of position and heading, in variances of a covariance.
struct Distances {
  double position, yaw;
};

Distances distances(const Eigen::Vector3d& off, const Eigen::Matrix3d& covariance) {
  const Eigen::Vector2d place = off.head<2>();
  return {place.dot(covariance.topLeftCorner<2, 2>().inverse() * place), off.z() * off.z() / covariance(2, 2)};
}

// The part of a covariance beyond what a match is off by anyway: systematic errors of wheels must not pull it where
// walls determine it well.
Eigen::Matrix3d uncertainPart(const Eigen::Matrix3d& covariance) {
  constexpr double kSure = 0.006, kLever = 2;  // [m] standard deviation, [m] by which angles count
  const Eigen::Vector3d scale(1, 1, kLever);
  const auto eigen = geometry::eigenOf<3>(scale.asDiagonal() * covariance * scale.asDiagonal());
  const Eigen::Vector3d left = (eigen.values.array() - mrpt::square(kSure)).max(0.0);
  const Eigen::Matrix3d part = eigen.vectors * left.asDiagonal() * eigen.vectors.transpose();
  return scale.cwiseInverse().asDiagonal() * part * scale.cwiseInverse().asDiagonal();
}

// What a contradiction of `squared_sigmas` adds to the variance of a measured motion, as a share of its square. Up to
// three standard deviations there is none; beyond six, wheels have slipped.
double shareOfSlip(double squared_sigmas) {
  return std::clamp((squared_sigmas - 9) / (36 - 9), 0.0, 1.0);
}

// Whether a contradiction matters. A match that is as far from the wheels is right, because they slipped, or it is
// wrong; which of the two is not known, so the covariance covers both until closures decide.
bool isLarge(const Eigen::Vector3d& off) {
  constexpr double kLarge = 0.1, kLargeTurn = 0.087;  // [m] [rad]
  return off.head<2>().norm() > kLarge || std::abs(off.z()) > kLargeTurn;
}

}  // namespace

void combine(const MeasuredMotion& measured, ScanTracker::Tracked& tracked) {
  // The pose before the motion is uncertain, too: in a steady state by about twice what a motion adds.
  constexpr double kCarried = 3;
  auto& match = tracked.match;
  const Eigen::Vector3d off = vectorOf(match.reference_from_scan - measured.motion);
  const auto apart = distances(off, measured.covariance + tracked.covariance);
  const Eigen::Vector3d place(off.x(), off.y(), 0), turn(0, 0, off.z());
  const Eigen::Matrix3d slip =
      shareOfSlip(apart.position) * place * place.transpose() + shareOfSlip(apart.yaw) * turn * turn.transpose();
  const Eigen::Matrix3d prior = kCarried * measured.covariance + slip;
  if (isLarge(off)) tracked.search_covariance += slip;
  const Eigen::Vector3d step = prior * (prior + uncertainPart(tracked.covariance)).ldlt().solve(off);
  match.reference_from_scan = measured.motion + TPose2D(step.x(), step.y(), step.z());
  tracked.difference = (off - step).head<2>();
  tracked.difference_covariance =
      (measured.covariance + mrpt::square(match.point_sigma) * match.unit_covariance).topLeftCorner<2, 2>();
}

}  // namespace omnimapper::matching
