#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/motion/OdometryCalibration.h>

#include <Eigen/LU>
#include <cmath>

namespace omnimapper::motion {

namespace {

constexpr double kDegree = base::option_text::kRadiansPerDegree;
// Standard deviations of the random errors of wheels, and of the matches that they are compared with.
constexpr double kTravelNoise = 0.05, kMatchNoise = 0.01;  // [m / sqrt(m)] [m]
constexpr double kTurnPerTravel = 2 * kDegree, kTurnNoise = 0.06,
                 kHeadingNoise = 0.003;  // [rad / sqrt(m), sqrt(rad)] [rad]
// Standard deviations of the systematic errors of wheels before anything was learned.
constexpr double kTravelError = 0.03, kTurnErrorPerTravel = 1 * kDegree, kTurnError = 0.05;
constexpr double kMemory = 25;  // [m] of distance travelled; a radian of turn counts as a metre
constexpr double kFar = 4;      // standard deviations

}  // namespace

void OdometryCalibration::learn(const mrpt::math::TPose2D& measured, const mrpt::math::TPose2D& actual) {
  const double travel = std::abs(measured.x), turn = std::abs(measured.phi);
  const double travel_variance = mrpt::square(kTravelNoise) * travel + mrpt::square(kMatchNoise);
  const double turn_variance =
      mrpt::square(kTurnPerTravel) * travel + mrpt::square(kTurnNoise) * turn + mrpt::square(kHeadingNoise);
  const Eigen::Vector2d turn_row(measured.x, measured.phi);
  const double off = actual.x - measured.x, turned_off = mrpt::math::wrapToPi(actual.phi - measured.phi);
  const auto isFar = [](double residual, double variance) {
    return mrpt::square(residual) > mrpt::square(kFar) * variance;
  };
  if (!std::isfinite(off) || !std::isfinite(turned_off)) return;
  if (isFar(off, travel_variance + mrpt::square(kTravelError * travel))) return;
  if (isFar(turned_off, turn_variance + mrpt::square(kTurnErrorPerTravel * travel) + mrpt::square(kTurnError * turn)))
    return;
  const double kept = std::exp(-(travel + turn) / kMemory);
  travel_information_ = kept * travel_information_ + mrpt::square(measured.x) / travel_variance;
  travel_sum_ = kept * travel_sum_ + measured.x * off / travel_variance;
  turn_information_ = kept * turn_information_ + turn_row * turn_row.transpose() / turn_variance;
  turn_sum_ = kept * turn_sum_ + turn_row * turned_off / turn_variance;
}

double OdometryCalibration::travelError() const {
  return travel_sum_ / (travel_information_ + 1 / mrpt::square(kTravelError));
}

Eigen::Vector2d OdometryCalibration::turnErrors() const {
  Eigen::Matrix2d information = turn_information_;
  information.diagonal() += Eigen::Vector2d(1 / mrpt::square(kTurnErrorPerTravel), 1 / mrpt::square(kTurnError));
  return information.inverse() * turn_sum_;
}

mrpt::math::TPose2D OdometryCalibration::applied(const mrpt::math::TPose2D& measured) const {
  const double travel = 1 + travelError();
  return {travel * measured.x, travel * measured.y,
          measured.phi + turnErrors().dot(Eigen::Vector2d(measured.x, measured.phi))};
}

}  // namespace omnimapper::motion
