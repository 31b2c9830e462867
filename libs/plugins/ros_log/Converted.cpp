#include "Converted.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/geometry/Conversions.h>

#include <algorithm>
#include <cmath>

#include "Channel.h"
#include "Transforms.h"

namespace omnimapper::ros {

namespace {

// Of a LaserEcho, its first number; of a number, itself.
float rangeAt(const Value& ranges, bool are_echoes, std::size_t beam) {
  if (!are_echoes) return static_cast<float>(ranges.number(beam));
  const Value& echoes = ranges[beam]["echoes"];
  return echoes.size() > 0 ? static_cast<float>(echoes.number(0)) : std::numeric_limits<float>::infinity();
}

double stepOf(const Value& message, std::size_t beams) {
  const double stated = message["angle_increment"].number();
  if (std::isfinite(stated) && stated != 0) return stated;
  const double field = message["angle_max"].number() - message["angle_min"].number();
  return beams > 1 ? field / static_cast<double>(beams - 1) : 0;
}

// A laser that states no limit has none.
float farthestOf(const Value& message) {
  constexpr float kNone = 10'000;  // [m]
  const auto stated = static_cast<float>(message["range_max"].number());
  return stated > 0 && stated < kNone ? stated : kNone;
}

std::uint8_t qualityOf(int status) {
  constexpr int kNoFix = -1, kPlain = 0;
  constexpr std::uint8_t kGgaNone = 0, kGgaPlain = 1, kGgaDifferential = 2;
  if (status <= kNoFix) return kGgaNone;
  return status == kPlain ? kGgaPlain : kGgaDifferential;
}

}  // namespace

std::string frameIn(const Value& text) {
  constexpr std::size_t kLongest = 1000;  // [bytes]
  if (text.text().size() > kLongest) throw BadBytes("has a frame whose name is longer than 1000 bytes");
  return frameName(text.text());
}

Header headerOf(const Value& message) {
  const Value& header = message["header"];
  return {frameIn(header["frame_id"]), boundedTime(header["stamp"].nanoseconds()),
          header.has("seq") ? header["seq"].integer() : -1};
}

base::Stamp stampOf(std::int64_t nanoseconds) {
  constexpr std::int64_t kTick = 100;  // [ns]
  return base::stampFromUnix(0) + base::Duration(nanoseconds / kTick);
}

geometry::Se3 poseOf(const Value& pose) {
  const Value &place = pose.either("position", "translation"), &turn = pose.either("orientation", "rotation");
  const Eigen::Quaterniond rotation(turn["w"].number(), turn["x"].number(), turn["y"].number(), turn["z"].number());
  const geometry::Se3 made{rotation.normalized(), place.vector()};
  // All zeros are a rotation that somebody did not set.
  if (!(rotation.norm() > 0.5 && rotation.norm() < 2) || !made.translation.allFinite())
    throw BadBytes("has a pose without a valid rotation");
  return made;
}

geometry::Se3 innerPoseOf(const Value& message) {
  const Value& pose = message["pose"];
  return poseOf(pose.has("pose") ? pose["pose"] : pose);
}

Converted scanOf(const Value& message) {
  const Value& ranges = message["ranges"];
  const std::size_t beams = ranges.size();
  const double step = stepOf(message, beams), span = step * static_cast<double>(beams > 0 ? beams - 1 : 0);
  const auto nearest = static_cast<float>(message["range_min"].number());
  const auto farthest = farthestOf(message);
  const bool are_echoes = ranges.isListOfMessages();
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->rightToLeft = step >= 0;
  scan->aperture = static_cast<float>(std::abs(span));
  scan->maxRange = farthest;
  scan->resizeScan(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const float range = rangeAt(ranges, are_echoes, i);
    const bool has_no_echo = range > farthest;
    scan->setScanRange(i, has_no_echo ? farthest : std::isfinite(range) ? range : 0.F);
    scan->setScanRangeValidity(i, range > 0 && range >= nearest);
  }
  // MRPT's beams are symmetric about the sensor's x axis.
  const double middle = message["angle_min"].number() + 0.5 * span;
  return {scan, headerOf(message).frame, geometry::lift({0, 0, std::isfinite(middle) ? middle : 0})};
}

double sweepOf(const Value& message) {
  const double of_beams = message["time_increment"].number() * static_cast<double>(message["ranges"].size());
  return std::isfinite(of_beams) && of_beams > 0 ? of_beams : 0;
}

Converted imuOf(const Value& message) {
  using namespace mrpt::obs;
  auto imu = CObservationIMU::Create();
  const Eigen::Vector3d rate = message["angular_velocity"].vector(), force = message["linear_acceleration"].vector();
  // The first element of a covariance is -1 where the sensor does not measure this.
  if (message["angular_velocity_covariance"].number(0) >= 0) {
    imu->set(IMU_WX, rate.x());
    imu->set(IMU_WY, rate.y());
    imu->set(IMU_WZ, rate.z());
  }
  if (message["linear_acceleration_covariance"].number(0) >= 0) {
    imu->set(IMU_X_ACC, force.x());
    imu->set(IMU_Y_ACC, force.y());
    imu->set(IMU_Z_ACC, force.z());
  }
  const Value& turn = message["orientation"];
  const Eigen::Quaterniond rotation(turn["w"].number(), turn["x"].number(), turn["y"].number(), turn["z"].number());
  if (message["orientation_covariance"].number(0) >= 0 && std::abs(rotation.norm() - 1) < 0.1) {
    imu->set(IMU_ORI_QUAT_W, rotation.w());
    imu->set(IMU_ORI_QUAT_X, rotation.x());
    imu->set(IMU_ORI_QUAT_Y, rotation.y());
    imu->set(IMU_ORI_QUAT_Z, rotation.z());
  }
  return {imu, headerOf(message).frame, {}};
}

Converted gpsOf(const Value& message) {
  auto gps = mrpt::obs::CObservationGPS::Create();
  mrpt::obs::gnss::Message_NMEA_GGA gga;
  gga.fields.fix_quality = qualityOf(static_cast<int>(message["status"]["status"].integer()));
  gga.fields.latitude_degrees = message["latitude"].number();
  gga.fields.longitude_degrees = message["longitude"].number();
  gga.fields.altitude_meters = message["altitude"].number();  // above the ellipsoid, as geoidal_distance is 0
  gga.fields.thereis_HDOP = false;
  if (!std::isfinite(gga.fields.latitude_degrees) || !std::isfinite(gga.fields.longitude_degrees))
    gga.fields.fix_quality = 0;
  gps->setMsg(gga);
  return {gps, headerOf(message).frame, {}};
}

Converted odometryOf(const Value& message) {
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->odometry = mrpt::poses::CPose2D(geometry::toMrpt(geometry::project(innerPoseOf(message))));
  const Value& twist = message["twist"]["twist"];
  const double forward = twist["linear"]["x"].number(), left = twist["linear"]["y"].number();
  const double turn = twist["angular"]["z"].number();
  odometry->hasVelocities = std::isfinite(forward) && std::isfinite(left) && std::isfinite(turn);
  if (odometry->hasVelocities) odometry->velocityLocal = {forward, left, turn};
  return {odometry, frameIn(message["child_frame_id"]), {}};
}

}  // namespace omnimapper::ros
