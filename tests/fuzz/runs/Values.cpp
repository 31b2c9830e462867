#include "Values.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationObjects.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace omnimapper::fuzz {

using namespace mrpt::obs;

namespace {

constexpr std::size_t kOfALongVector = 40;

// The conversion of a double that is out of the range of an integer type is undefined, so it gives the nearest integer
// of that type, and 0 for NaN.
template <class Number>
Number as(double value) {
  if constexpr (std::is_same_v<Number, bool>) {
    return value != 0;
  } else if constexpr (std::is_floating_point_v<Number>) {
    return static_cast<Number>(value);
  } else {
    if (std::isnan(value)) return 0;
    constexpr auto kLowest = std::numeric_limits<Number>::lowest(), kLargest = std::numeric_limits<Number>::max();
    if (value <= static_cast<double>(kLowest)) return kLowest;
    if (value >= static_cast<double>(kLargest)) return kLargest;
    return static_cast<Number>(value);
  }
}

class Collector {
 public:
  template <class Number>
  void number(Number& number) {
    values_.push_back(
        {[&number] { return static_cast<double>(number); }, [&number](double value) { number = as<Number>(value); }});
  }
  template <class... Numbers>
  void numbers(Numbers&... numbers) {
    (number(numbers), ...);
  }
  template <class Matrix>
  void matrix(Matrix& matrix) {
    for (int row = 0; row < matrix.rows(); ++row) {
      for (int column = 0; column < matrix.cols(); ++column) number(matrix(row, column));
    }
  }
  void pose(mrpt::poses::CPose3D& pose) {
    for (unsigned i = 0; i < 3; ++i) {
      values_.push_back(
          {[&pose, i] { return pose.m_coords[i]; }, [&pose, i](double value) { pose.m_coords[i] = value; }});
    }
    const auto angle = [&](auto get, auto replaced) {
      values_.push_back({[&pose, get] { return get(pose); },
                         [&pose, replaced](double value) {
                           double angles[] = {pose.yaw(), pose.pitch(), pose.roll()};
                           replaced(angles) = value;
                           pose.setFromValues(pose.x(), pose.y(), pose.z(), angles[0], angles[1], angles[2]);
                         }});
    };
    angle([](const auto& of) { return of.yaw(); }, [](double* angles) -> double& { return angles[0]; });
    angle([](const auto& of) { return of.pitch(); }, [](double* angles) -> double& { return angles[1]; });
    angle([](const auto& of) { return of.roll(); }, [](double* angles) -> double& { return angles[2]; });
  }
  void pose(mrpt::poses::CPose2D& pose) {
    values_.push_back({[&pose] { return pose.x(); }, [&pose](double value) { pose.x(value); }});
    values_.push_back({[&pose] { return pose.y(); }, [&pose](double value) { pose.y(value); }});
    values_.push_back({[&pose] { return pose.phi(); }, [&pose](double value) { pose.phi(value); }});
  }
  void camera(mrpt::img::TCamera& camera) {
    matrix(camera.intrinsicParams);
    for (double& distortion : camera.dist) number(distortion);
    numbers(camera.ncols, camera.nrows);
  }
  template <class Vector>
  void some(Vector& vector) {
    const std::size_t step = std::max<std::size_t>(1, vector.size() / kOfALongVector);
    for (std::size_t i = 0; i < vector.size(); i += step) number(vector[i]);
  }
  void add(Value value) { values_.push_back(std::move(value)); }
  std::vector<Value> take() { return std::move(values_); }

 private:
  std::vector<Value> values_;
};

// Limits the length of a vector to one that a log of this size could have.
std::size_t lengthOf(double value) {
  return std::isfinite(value) && value > 0 ? static_cast<std::size_t>(std::min(value, 20000.0)) : 0;
}

void collect(CObservation2DRangeScan& scan, Collector& values) {
  values.numbers(scan.aperture, scan.maxRange, scan.stdError, scan.beamAperture, scan.deltaPitch, scan.rightToLeft);
  values.pose(scan.sensorPose);
  values.add({[&] { return static_cast<double>(scan.getScanSize()); },
              [&](double value) { scan.resizeScan(lengthOf(value)); }});
  const std::size_t step = std::max<std::size_t>(1, scan.getScanSize() / kOfALongVector);
  for (std::size_t i = 0; i < scan.getScanSize(); i += step) {
    values.add({[&scan, i] { return i < scan.getScanSize() ? scan.getScanRange(i) : 0; },
                [&scan, i](double value) {
                  if (i >= scan.getScanSize()) return;
                  scan.setScanRange(i, static_cast<float>(value));
                  scan.setScanRangeValidity(i, true);
                }});
  }
}

void collect(CObservation3DRangeScan& scan, Collector& values) {
  values.numbers(scan.maxRange, scan.stdError, scan.rangeUnits, scan.hasRangeImage, scan.hasIntensityImage,
                 scan.hasPoints3D, scan.range_is_depth);
  values.pose(scan.sensorPose);
  values.pose(scan.relativePoseIntensityWRTDepth);
  values.camera(scan.cameraParams);
  values.camera(scan.cameraParamsIntensity);
  values.add({[&] { return static_cast<double>(scan.rangeImage.rows()); },
              [&](double value) {
                const auto rows = static_cast<int>(lengthOf(value) % 700);
                scan.rangeImage_setSize(rows, static_cast<int>(scan.rangeImage.cols()));
              }});
  const std::size_t size = scan.rangeImage.size();
  for (std::size_t i = 0; i < size; i += std::max<std::size_t>(1, size / 20)) {
    values.add({[&scan, i] { return i < scan.rangeImage.size() ? scan.rangeImage.data()[i] : 0; },
                [&scan, i](double value) {
                  if (i < scan.rangeImage.size()) scan.rangeImage.data()[i] = as<std::uint16_t>(value);
                }});
  }
}

void collect(CObservationBearingRange& measurement, Collector& values) {
  values.numbers(measurement.minSensorDistance, measurement.maxSensorDistance, measurement.fieldOfView_yaw,
                 measurement.fieldOfView_pitch, measurement.sensor_std_range, measurement.sensor_std_yaw,
                 measurement.sensor_std_pitch, measurement.validCovariances);
  values.pose(measurement.sensorLocationOnRobot);
  for (auto& one : measurement.sensedData) {
    values.numbers(one.range, one.yaw, one.pitch, one.landmarkID);
    if (measurement.validCovariances) values.matrix(one.covariance);
  }
}

void collect(CObservationOdometry& odometry, Collector& values) {
  values.pose(odometry.odometry);
  values.numbers(odometry.hasEncodersInfo, odometry.hasVelocities, odometry.encoderLeftTicks,
                 odometry.encoderRightTicks, odometry.velocityLocal.vx, odometry.velocityLocal.omega);
}

void collect(CObservationRobotPose& pose, Collector& values) {
  values.pose(pose.pose.mean);
  values.pose(pose.sensorPose);
  values.matrix(pose.pose.cov);
}

void collect(CObservationGPS& gps, Collector& values) {
  values.pose(gps.sensorPose);
  if (!gps.hasMsgClass<gnss::Message_NMEA_GGA>()) return;
  auto& fix = gps.getMsgByClass<gnss::Message_NMEA_GGA>().fields;
  values.numbers(fix.latitude_degrees, fix.longitude_degrees, fix.altitude_meters, fix.geoidal_distance, fix.HDOP,
                 fix.fix_quality, fix.satellitesUsed);
}

void collect(CObservationIMU& imu, Collector& values) {
  values.pose(imu.sensorPose);
  values.some(imu.rawMeasurements);
}

void collect(CObservationImage& image, Collector& values) {
  values.pose(image.cameraPose);
  values.camera(image.cameraParams);
}

void collect(obs::CObservationRelativeMotion& motion, Collector& values) {
  values.pose(motion.begin_from_end);
  values.matrix(motion.covariance);
}

void collect(geometry::Polygon3& polygon, Collector& values) {
  for (auto& point : polygon.vertices) values.matrix(point);
}

void collect(obs::CObservationPlanes& found, Collector& values) {
  values.pose(found.sensorPose);
  for (auto& plane : found.planes) {
    values.matrix(plane.plane_in_sensor.normal);
    values.numbers(plane.plane_in_sensor.distance, plane.inliers, plane.rms);
    values.matrix(plane.covariance);
    values.matrix(plane.centroid);
    collect(plane.outline, values);
    for (auto& hole : plane.holes) collect(hole, values);
  }
}

void collect(obs::CObservationLaserLines& found, Collector& values) {
  values.pose(found.sensorPose);
  for (auto& line : found.lines) {
    values.matrix(line.segment_in_sensor.from);
    values.matrix(line.segment_in_sensor.to);
    values.matrix(line.covariance);
    values.numbers(line.angle, line.distance, line.first_beam, line.last_beam, line.inliers, line.rms);
  }
}

void collect(obs::CObservationObjects& found, Collector& values) {
  values.pose(found.sensorPose);
  for (auto& object : found.objects) {
    values.matrix(object.centroid);
    values.matrix(object.covariance);
    values.matrix(object.box_size);
    values.matrix(object.sensor_from_box.translation);
    values.matrix(object.sensor_from_box.rotation.coeffs());
    values.number(object.score);
    if (object.supporting_plane) values.number(*object.supporting_plane);
    for (std::size_t i = 0; i < object.points.size(); i += 1 + object.points.size() / 5)
      values.matrix(object.points[i]);
  }
}

template <class Class>
bool collectAs(CObservation& observation, Collector& values) {
  auto* it = dynamic_cast<Class*>(&observation);
  if (it) collect(*it, values);
  return it != nullptr;
}

template <class... Classes>
bool collectAsOneOf(CObservation& observation, Collector& values) {
  return (collectAs<Classes>(observation, values) || ...);
}

}  // namespace

std::vector<Value> valuesOf(CObservation& observation) {
  Collector values;
  const bool is_known = collectAsOneOf<CObservation2DRangeScan, CObservation3DRangeScan, CObservationBearingRange,
                                       CObservationOdometry, CObservationRobotPose, CObservationGPS, CObservationIMU,
                                       CObservationImage, obs::CObservationRelativeMotion, obs::CObservationPlanes,
                                       obs::CObservationLaserLines, obs::CObservationObjects>(observation, values);
  if (!is_known) {
    values.add({[&] { return observation.sensorPose().x; },
                [&](double value) {
                  auto pose = observation.sensorPose();
                  observation.setSensorPose(mrpt::poses::CPose3D(value, pose.y, pose.z, 0, 0, 0));
                }});
  }
  return values.take();
}

}  // namespace omnimapper::fuzz
