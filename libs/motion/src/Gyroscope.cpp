#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/motion/Gyroscope.h>

#include <algorithm>

namespace omnimapper::motion {

namespace {

constexpr double kScale = 0.005;  // largest relative error of a rate's scale

std::optional<Eigen::Vector3d> rateInBase(const mrpt::obs::CObservationIMU& imu) {
  using namespace mrpt::obs;
  if (!imu.has(IMU_WX) || !imu.has(IMU_WY) || !imu.has(IMU_WZ)) return std::nullopt;
  constexpr double kFastest = 100;  // [rad/s] more than a sensor can show
  const Eigen::Vector3d rate(imu.get(IMU_WX), imu.get(IMU_WY), imu.get(IMU_WZ));
  if (!(rate.cwiseAbs().maxCoeff() < kFastest)) return std::nullopt;  // rejects NaN, too
  return geometry::fromMrpt(imu.sensorPose).rotation * rate;
}

}  // namespace

bool Gyroscope::add(const mrpt::obs::CObservation& observation) {
  const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation);
  if (imu == nullptr) return false;
  const std::string& wanted = !options_.label.empty() ? options_.label : label_ ? *label_ : imu->sensorLabel;
  const auto rate = rateInBase(*imu);
  if (imu->sensorLabel != wanted || !rate || (last_ && imu->timestamp <= last_->stamp)) return false;
  label_ = imu->sensorLabel;
  constexpr double kLongest = 0.1;  // [s] between readings
  const double seconds = last_ ? base::secondsBetween(last_->stamp, imu->timestamp) : 0;
  if (last_ && seconds <= kLongest) {
    const Eigen::Vector3d turned = 0.5 * seconds * (last_->rate + *rate);
    RelativeMotion motion{geometry::toMrpt(geometry::Se3{geometry::expSo3(turned), Eigen::Vector3d::Zero()}),
                          geometry::Matrix6d::Zero()};
    motion.covariance.diagonal().tail<3>().setConstant(variance(options_.noise_per_root_s) * seconds);
    timeline_.insert(last_->stamp, imu->timestamp, motion);
  }
  last_ = Reading{imu->timestamp, *rate};
  return true;
}

std::optional<Turn> Gyroscope::between(base::Stamp begin, base::Stamp end) const {
  const auto motion = timeline_.between(begin, end);
  if (!motion) return std::nullopt;
  const double seconds = base::secondsBetween(begin, end);
  const Eigen::Vector3d turned =
      geometry::logSo3(geometry::fromMrpt(motion->begin_from_end).rotation) - seconds * bias_;
  const Eigen::Matrix3d covariance = motion->covariance.bottomRightCorner<3, 3>() +
                                     kScale * kScale * turned * turned.transpose() +
                                     seconds * seconds * bias_variance_ * Eigen::Matrix3d::Identity();
  return Turn{geometry::expSo3(turned), covariance};
}

void Gyroscope::learn(base::Stamp begin, base::Stamp end, const Eigen::Quaterniond& begin_from_end, double sigma) {
  const auto motion = timeline_.between(begin, end);
  const double seconds = base::secondsBetween(begin, end);
  if (!motion || seconds <= 0) return;
  constexpr double kFarthest = 2;  // [rad] a larger turn could be one in the other direction
  const Eigen::Vector3d raw = geometry::logSo3(geometry::fromMrpt(motion->begin_from_end).rotation);
  const Eigen::Vector3d measured = geometry::logSo3(begin_from_end);
  if (raw.norm() > kFarthest || measured.norm() > kFarthest) return;
  const Eigen::Vector3d shown = (raw - measured) / seconds;
  // The bias drifts as the sensor warms up: 0.06 deg/s in 100 s.
  constexpr double kDrift = 1e-4;  // [rad/s] after 1 s; grows with the root of time
  if (learnt_) bias_variance_ += variance(kDrift) * std::max(0.0, base::secondsBetween(*learnt_, end));
  learnt_ = end;
  const double expected = bias_variance_ + variance(sigma / seconds) + variance(kScale * raw.norm() / seconds);
  constexpr double kSigmas = 5;  // beyond this the other sensor was wrong
  if ((shown - bias_).squaredNorm() > variance(kSigmas) * 3 * expected) return;
  const double gain = bias_variance_ / expected;
  bias_ += gain * (shown - bias_);
  bias_variance_ *= 1 - gain;
}

}  // namespace omnimapper::motion
