#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>
#include <omnimapper/motion/OdometryErrors.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::motion {

using mrpt::math::TPose2D;

namespace {

constexpr double kLongSpan = 1;        // [m] and [rad] of a span
constexpr double kKeptOfRate = 0.9;    // of each span
constexpr double kKeptOfScans = 0.95;  // of the mean error from scan to scan
constexpr double kTravelOfTurn = 0.1;  // [m/rad] a base that turns on the spot moves its origin a little
constexpr double kLeastError = 0.002, kLeastYawError = 0.002;  // [m] [rad] standard deviation of the shortest motion

double distanceOf(const TPose2D& motion) {
  return std::hypot(motion.x, motion.y);
}

}  // namespace

void OdometryErrors::add(const TPose2D& measured, const TPose2D& actual, double position_variance,
                         double yaw_variance) {
  const TPose2D apart = actual - measured;
  // A single large error, as of a wrong match, counts as three standard deviations.
  const auto learn = [](double& mean, double squared, double of_match, double usual) {
    if (!std::isfinite(squared)) return;
    const double most = 9 * std::max(mean, usual);
    mean += (1 - kKeptOfScans) * (std::clamp(squared - of_match, 0.0, most) - mean);
  };
  const auto usual = covarianceOf(measured);
  learn(scan_position_, 0.5 * mrpt::square(distanceOf(apart)), position_variance, usual(0, 0));
  learn(scan_yaw_, mrpt::square(mrpt::math::wrapToPi(apart.phi)), yaw_variance, usual(2, 2));
  measured_ = measured_ + measured;
  actual_ = actual_ + actual;
  travel_ += distanceOf(measured);
  turn_ += std::abs(mrpt::math::wrapToPi(measured.phi));
  if (travel_ + turn_ < kLongSpan) return;
  const TPose2D off = actual_ - measured_;
  const double position = 0.5 * mrpt::square(distanceOf(off)) / (travel_ + kTravelOfTurn * turn_);
  const double yaw = mrpt::square(mrpt::math::wrapToPi(off.phi)) / (travel_ + turn_);
  if (std::isfinite(position) && std::isfinite(yaw)) {
    position_rate_ = kKeptOfRate * position_rate_ + (1 - kKeptOfRate) * position;
    yaw_rate_ = kKeptOfRate * yaw_rate_ + (1 - kKeptOfRate) * yaw;
  }
  interrupt();
}

void OdometryErrors::interrupt() {
  measured_ = actual_ = {};
  travel_ = turn_ = 0;
}

Eigen::Matrix3d OdometryErrors::covarianceOf(const TPose2D& measured) const {
  const double travel = distanceOf(measured), turn = std::abs(mrpt::math::wrapToPi(measured.phi));
  const double position = std::max(scan_position_,
                                   mrpt::square(kLeastError) + position_rate_ * (travel + kTravelOfTurn * turn)),
               yaw = std::max(scan_yaw_, mrpt::square(kLeastYawError) + yaw_rate_ * (travel + turn));
  return Eigen::Vector3d(position, position, yaw).asDiagonal();
}

}  // namespace omnimapper::motion
