#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/motion/Gravity.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace omnimapper::motion {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kStandardGravity = 9.80665;  // [m/s^2]

std::optional<Vector3d> forceInBase(const mrpt::obs::CObservationIMU& imu) {
  using namespace mrpt::obs;
  if (!imu.has(IMU_X_ACC) || !imu.has(IMU_Y_ACC) || !imu.has(IMU_Z_ACC)) return std::nullopt;
  constexpr double kLargest = 1e4;  // more than any sensor shows, in any unit
  const Vector3d force(imu.get(IMU_X_ACC), imu.get(IMU_Y_ACC), imu.get(IMU_Z_ACC));
  if (!(force.cwiseAbs().maxCoeff() < kLargest)) return std::nullopt;  // rejects NaN, too
  return geometry::fromMrpt(imu.sensorPose).rotation * force;
}

std::optional<double> turnRate(const mrpt::obs::CObservationIMU& imu) {
  using namespace mrpt::obs;
  if (!imu.has(IMU_WX) || !imu.has(IMU_WY) || !imu.has(IMU_WZ)) return std::nullopt;
  const double rate = Vector3d(imu.get(IMU_WX), imu.get(IMU_WY), imu.get(IMU_WZ)).norm();
  return std::isfinite(rate) ? std::optional(rate) : std::nullopt;
}

double angleBetween(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Matrix3d crossMatrix(const Vector3d& v) {
  Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

// The unit [m/s^2] of accelerations with this magnitude; none where they are not those of gravity.
std::optional<double> unitOf(double magnitude) {
  constexpr double kOff = 0.06;  // relative difference; biases and altitudes cause less
  for (const double unit : {1.0, kStandardGravity})
    if (std::abs(magnitude * unit / kStandardGravity - 1) < kOff) return unit;
  return std::nullopt;
}

std::string text(const char* format, double value, std::size_t count) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, value, count);
  return buffer;
}

/// Gravity in the map, then the bias in the base [m/s^2], with their covariance.
struct Solution {
  Eigen::Matrix<double, 6, 1> value = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Identity();
};

Solution solve(const std::vector<RotatedSpan>& spans, double unit) {
  constexpr double kBias = 0.1, kNoise = 0.03;  // [m/s^2]
  constexpr int kIterations = 30;
  constexpr double kCauchy = 2;
  using Jacobian = Eigen::Matrix<double, 3, 6>;
  Solution solution;
  double scale = 1;
  std::vector<double> weights(spans.size(), 1);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    information.diagonal().tail<3>().setConstant(1 / (kBias * kBias));
    const auto each = [&](const auto& work) {
      for (std::size_t i = 0; i < spans.size(); ++i) {
        Jacobian jacobian;
        jacobian << spans[i].map_from_base.conjugate().toRotationMatrix(), Matrix3d::Identity();
        work(i, jacobian, Vector3d(unit * spans[i].span.force), std::hypot(kNoise, unit * spans[i].span.scatter));
      }
    };
    each([&](std::size_t i, const Jacobian& jacobian, const Vector3d& force, double sigma) {
      const double weight = weights[i] / (scale * scale * sigma * sigma);
      information += weight * jacobian.transpose() * jacobian;
      sum += weight * jacobian.transpose() * force;
    });
    solution.covariance = information.inverse();
    const Eigen::Matrix<double, 6, 1> before = solution.value;
    solution.value = solution.covariance * sum;
    std::vector<double> sizes;
    each([&](std::size_t, const Jacobian& jacobian, const Vector3d& force, double sigma) {
      sizes.push_back((jacobian * solution.value - force).norm() / sigma);
    });
    // Half the residuals of three axes are within 1.538 standard deviations.
    scale = std::max(0.1, median(sizes) / 1.538);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const double off = sizes[i] / (kCauchy * scale);
      weights[i] = 1 / (1 + off * off);
    }
    if (iteration > 3 && (solution.value - before).norm() < 1e-9) break;
  }
  return solution;
}

}  // namespace

bool SteadySpans::add(const mrpt::obs::CObservationIMU& imu) {
  const auto force = forceInBase(imu);
  if (!force) return false;
  constexpr double kSpan = 0.5, kGap = 0.2;  // [s]
  if (sum_ && imu.timestamp <= sum_->end) return true;
  if (sum_ && base::secondsBetween(sum_->end, imu.timestamp) > kGap) sum_.reset();
  if (!sum_) sum_ = Sum{imu.timestamp, imu.timestamp};
  Sum& sum = *sum_;
  sum.end = imu.timestamp;
  const double seconds = base::secondsBetween(sum.begin, sum.end);
  sum.force += *force;
  sum.squares += force->squaredNorm();
  ++sum.readings;
  if (2 * seconds < kSpan) {
    sum.first_half += *force;
    ++sum.of_first_half;
  }
  if (const auto rate = turnRate(imu)) {
    sum.turning += *rate;
    ++sum.rates;
  }
  if (seconds >= kSpan) close();
  return true;
}

// Keeps the span if the base hardly turned; the next one begins with the next reading.
void SteadySpans::close() {
  constexpr std::size_t kFewest = 4;  // readings
  constexpr double kFastest = 0.35;   // [rad/s] on average
  constexpr double kTurned = 0.17;    // [rad] largest rotation between the halves of a span, if no rates are measured
  const Sum sum = *sum_;
  sum_.reset();
  if (sum.readings < kFewest || sum.of_first_half == 0 || sum.of_first_half == sum.readings) return;
  const auto count = static_cast<double>(sum.readings);
  const Vector3d mean = sum.force / count;
  if (!(mean.norm() > 0)) return;
  if (sum.rates > 0 && sum.turning / static_cast<double>(sum.rates) > kFastest) return;
  if (sum.rates == 0 && angleBetween(sum.first_half, sum.force - sum.first_half) > kTurned) return;
  const auto middle = base::durationFromSeconds(base::secondsBetween(sum.begin, sum.end) / 2);
  spans_.push_back({sum.begin + middle, mean, std::sqrt(std::max(0.0, sum.squares / count - mean.squaredNorm()))});
}

Gravity gravityOf(const std::vector<RotatedSpan>& spans) {
  constexpr std::size_t kFewest = 4;
  Gravity gravity;
  if (spans.size() < kFewest) {
    gravity.reason = "accelerations cover only " + std::to_string(spans.size()) + " half seconds without much turning";
    return gravity;
  }
  std::vector<double> magnitudes;
  for (const auto& one : spans) magnitudes.push_back(one.span.force.norm());
  const double magnitude = median(magnitudes);
  const auto unit = unitOf(magnitude);
  if (!unit) {
    gravity.reason = text(
        "accelerations are %.3g in the median, neither 9.81 m/s^2 nor 1 g: gravity was taken out "
        "of them, or they are in another unit",
        magnitude, 0);
    return gravity;
  }
  gravity.magnitude = *unit * magnitude;
  const Solution solution = solve(spans, *unit);
  const Vector3d sum = solution.value.head<3>();
  constexpr double kLeast = 0.5;  // share of gravity; with less the rotations do not fit the accelerations
  if (!(sum.norm() > kLeast * kStandardGravity)) {
    gravity.reason = text("accelerations of %.2f m/s^2 have no common direction in the map in %zu half seconds",
                          gravity.magnitude, spans.size());
    return gravity;
  }
  constexpr double kDrift = 0.1 * 3.14159265358979323846 / 180;  // [rad] error that all rotations of the map share
  gravity.up = sum.normalized();
  const Matrix3d turn = crossMatrix(*gravity.up) / sum.norm();
  const Matrix3d across = Matrix3d::Identity() - *gravity.up * gravity.up->transpose();
  gravity.covariance = turn * solution.covariance.topLeftCorner<3, 3>() * turn.transpose() + kDrift * kDrift * across;
  gravity.reason =
      text("gravity of %.2f m/s^2 in %zu half seconds without much turning", gravity.magnitude, spans.size());
  if (*unit != 1) gravity.reason += ", accelerations assumed to be in g";
  return gravity;
}

}  // namespace omnimapper::motion
