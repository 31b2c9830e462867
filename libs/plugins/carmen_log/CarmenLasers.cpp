#include "CarmenLasers.h"

#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace omnimapper::source {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadiansPerDegree = kPi / 180.0;
constexpr double kNoEcho = 80.0;  // [m] a SICK LMS reports 81.83 or 81.91 where nothing comes back

bool isRear(const CarmenScanLine& line) {
  return line.name == "RLASER";
}

// Angle between the beams of a SICK scanner [rad], for logs that do not state it. The field of view is 180 deg, or 100
// deg for the numbers of beams of that mode. An even number of beams leaves out the last angle.
double defaultStep(std::size_t beams) {
  const double field = beams == 101 || beams == 201 || beams == 401 ? 100.0 : 180.0;
  return field / static_cast<double>(beams % 2 == 0 ? beams : beams - 1) * kRadiansPerDegree;
}

}  // namespace

double CarmenLasers::number(const std::string& name, double otherwise) const {
  const auto found = parameters_.find(name);
  if (found == parameters_.end()) return otherwise;
  const std::string& text = found->second;
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc() && std::isfinite(value) ? value : otherwise;
}

CarmenBeams CarmenLasers::beamsOf(const CarmenScanLine& line) const {
  if (line.beams) return *line.beams;
  const std::string laser = isRear(line) ? "rear_laser" : "front_laser";
  CarmenBeams beams;
  const double step = number("laser_" + laser + "_resolution", 0.0) * kRadiansPerDegree;
  beams.step = step > 0 ? step : defaultStep(line.ranges.size());
  const double last = static_cast<double>(line.ranges.size() - 1) * beams.step;
  // An even count of beams leaves out the last angle of a field that is centred ahead.
  const double centred = line.ranges.size() % 2 == 0 ? last + beams.step : last;
  const double field = number("laser_" + laser + "_fov", 0.0) * kRadiansPerDegree;
  const bool field_fits = std::abs(field - last) < 1.5 * beams.step;
  beams.first_angle = -0.5 * (field_fits ? field : centred);
  beams.max_range = std::min(number("robot_" + laser + "_max", kNoEcho), kNoEcho);
  return beams;
}

mrpt::math::TPose2D CarmenLasers::baseFromLaser(const CarmenScanLine& line) const {
  if (line.beams) {
    const auto pose = mrpt::poses::CPose2D(line.laser_pose) - mrpt::poses::CPose2D(line.robot_pose);
    return pose.asTPose();
  }
  const std::string laser = isRear(line) ? "robot_rearlaser" : "robot_frontlaser";
  return {number(laser + "_offset", 0.0), number(laser + "_side_offset", 0.0),
          number(laser + "_angular_offset", isRear(line) ? kPi : 0.0)};
}

mrpt::obs::CObservation2DRangeScan::Ptr CarmenLasers::scan(const CarmenScanLine& line, base::Stamp stamp) const {
  const CarmenBeams beams = beamsOf(line);
  const auto base_from_laser = baseFromLaser(line);
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->sensorLabel = line.name;
  scan->timestamp = stamp;
  scan->rightToLeft = true;
  scan->maxRange = static_cast<float>(beams.max_range);
  scan->stdError = static_cast<float>(beams.sigma);
  // MRPT's beams are symmetric about the sensor's x axis, so the sensor is turned to the middle of CARMEN's beams.
  const double aperture = beams.step * static_cast<double>(line.ranges.size() - 1);
  scan->aperture = static_cast<float>(aperture);
  const double yaw = base_from_laser.phi + beams.first_angle + 0.5 * aperture;
  scan->sensorPose = mrpt::poses::CPose3D(base_from_laser.x, base_from_laser.y, 0, yaw, 0, 0);
  scan->resizeScan(line.ranges.size());
  for (std::size_t i = 0; i < line.ranges.size(); ++i) {
    const float range = line.ranges[i];
    scan->setScanRange(i, range);
    scan->setScanRangeValidity(i, range > 0 && range < beams.max_range);
  }
  return scan;
}

}  // namespace omnimapper::source
