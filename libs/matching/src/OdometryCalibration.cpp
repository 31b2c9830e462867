#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/matching/OdometryCalibration.h>

#include <Eigen/LU>
#include <cmath>

namespace omnimapper::matching {

namespace {

constexpr double kDegree = base::option_text::kRadiansPerDegree;
// What wheels err by at random, and the matches that they are held against.
constexpr double kWayNoise = 0.05, kMatchNoise = 0.01;  // [m / sqrt(m)] [m]
constexpr double kTurnPerWay = 2 * kDegree, kTurnNoise = 0.06,
                 kHeadingNoise = 0.003;  // [rad / sqrt(m), sqrt(rad)] [rad]
// What they err by systematically before anything is known of them: standard deviations.
constexpr double kWayError = 0.03, kTurnErrorPerWay = 1 * kDegree, kTurnError = 0.05;
constexpr double kMemory = 25;  // [m] of way, a radian of turn counts as a metre
constexpr double kFar = 4;      // standard deviations

}  // namespace

void OdometryCalibration::learn(const mrpt::math::TPose2D& told, const mrpt::math::TPose2D& was) {
  const double way = std::abs(told.x), turn = std::abs(told.phi);
  const double way_variance = mrpt::square(kWayNoise) * way + mrpt::square(kMatchNoise);
  const double turn_variance =
      mrpt::square(kTurnPerWay) * way + mrpt::square(kTurnNoise) * turn + mrpt::square(kHeadingNoise);
  const Eigen::Vector2d turn_row(told.x, told.phi);
  const double off = was.x - told.x, turned_off = mrpt::math::wrapToPi(was.phi - told.phi);
  const auto isFar = [](double residual, double variance) {
    return mrpt::square(residual) > mrpt::square(kFar) * variance;
  };
  if (!std::isfinite(off) || !std::isfinite(turned_off)) return;
  if (isFar(off, way_variance + mrpt::square(kWayError * way))) return;
  if (isFar(turned_off, turn_variance + mrpt::square(kTurnErrorPerWay * way) + mrpt::square(kTurnError * turn))) return;
  const double kept = std::exp(-(way + turn) / kMemory);
  way_information_ = kept * way_information_ + mrpt::square(told.x) / way_variance;
  way_sum_ = kept * way_sum_ + told.x * off / way_variance;
  turn_information_ = kept * turn_information_ + turn_row * turn_row.transpose() / turn_variance;
  turn_sum_ = kept * turn_sum_ + turn_row * turned_off / turn_variance;
}

double OdometryCalibration::wayError() const {
  return way_sum_ / (way_information_ + 1 / mrpt::square(kWayError));
}

Eigen::Vector2d OdometryCalibration::turnErrors() const {
  Eigen::Matrix2d information = turn_information_;
  information.diagonal() += Eigen::Vector2d(1 / mrpt::square(kTurnErrorPerWay), 1 / mrpt::square(kTurnError));
  return information.inverse() * turn_sum_;
}

mrpt::math::TPose2D OdometryCalibration::applied(const mrpt::math::TPose2D& told) const {
  const double way = 1 + wayError();
  return {way * told.x, way * told.y, told.phi + turnErrors().dot(Eigen::Vector2d(told.x, told.phi))};
}

}  // namespace omnimapper::matching
