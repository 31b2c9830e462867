#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/math/TPose3D.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/topography/conversions.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace omnimapper::testing {

using mrpt::obs::CObservation;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

namespace {

using geometry::kPi;
constexpr double kRamp = 1;  // [s]

// Heading in a bend of a quarter turn after the part [0, 1] of its length. The turning begins and ends smoothly.
double bendHeading(double part) {
  return kPi / 2 * part * part * (3 - 2 * part);
}

// Position in a bend of that length that begins at the origin, integrated by Simpson's rule.
Eigen::Vector2d alongBend(double length, double part) {
  constexpr int kSteps = 64;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i <= kSteps; ++i) {
    const double weight = i == 0 || i == kSteps ? 1 : (i % 2 == 1 ? 4 : 2);
    const double heading = bendHeading(part * i / kSteps);
    sum += weight * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  }
  return sum * length * part / (3 * kSteps);
}

std::vector<base::Stamp> stampsOf(const SimulatedLog& log, double rate, double phase) {
  std::vector<base::Stamp> stamps;
  for (int i = 0;; ++i) {
    stamps.push_back(log.begin() + base::durationFromSeconds(phase + i / rate));
    if (stamps.back() > log.end()) break;
  }
  stamps.pop_back();
  return stamps;
}

}  // namespace

double Dice::uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
}

double Dice::normal(double sigma) {
  const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
  return sigma * radius * std::cos(uniform(0, 2 * kPi));
}

SimulatedLog::SimulatedLog(const SimulatedLogOptions& options) : options_(options) {
  const bool ring = options.place == SimulatedLogOptions::Place::ring;
  plan_ = ring ? FloorPlan::ring() : FloorPlan::box();
  corner_ = ring ? 2.4 : 1.6;
  const double cut = alongBend(corner_, 1).x();
  straight_x_ = (ring ? 17 : 5) - 2 * cut;
  straight_y_ = (ring ? 9 : 3) - 2 * cut;
  duration_ = options.laps * lapLength() / options.speed + kRamp;
}

CPose2D SimulatedLog::poseAfter(double travel) const {
  CPose2D pose;
  double left = std::fmod(travel, lapLength());
  const double straights[] = {straight_x_ / 2, straight_y_, straight_x_, straight_y_, straight_x_ / 2};
  for (int side = 0; side < 5; ++side) {
    const double ahead = std::min(left, straights[side]);
    pose = pose + CPose2D(ahead, 0, 0);
    left -= ahead;
    if (side == 4 || left <= 0) break;
    const double part = std::min(1.0, left / corner_);
    const Eigen::Vector2d bend = alongBend(corner_, part);
    pose = pose + CPose2D(bend.x(), bend.y(), bendHeading(part));
    left -= part * corner_;
  }
  return pose;
}

CPose2D SimulatedLog::truthAt(base::Stamp stamp) const {
  const double t = std::clamp(base::secondsBetween(begin_, stamp), 0.0, duration_);
  const auto ramp = [](double s) { return s / 2 - kRamp / (2 * kPi) * std::sin(kPi * s / kRamp); };
  double seconds = t - kRamp / 2;
  if (t < kRamp) seconds = ramp(t);
  if (t > duration_ - kRamp) seconds = duration_ - kRamp - ramp(duration_ - t);
  return poseAfter(options_.speed * seconds);
}

std::vector<SimulatedLog::Odometry> SimulatedLog::odometry() const {
  Dice dice(options_.seed);
  std::vector<Odometry> all;
  CPose2D odom_from_base;
  // The odometry has one reading after the end, so that it covers all other observations.
  auto stamps = stampsOf(*this, options_.odometry_rate, 0);
  stamps.push_back(stamps.back() + base::durationFromSeconds(1 / options_.odometry_rate));
  for (const auto stamp : stamps) {
    if (!all.empty()) {
      const CPose2D motion = truthAt(stamp) - truthAt(all.back().stamp);
      const double travel = motion.norm();
      const double jitter = dice.normal(options_.position_noise_per_root_m * std::sqrt(travel));
      const double turn = motion.phi() + options_.yaw_drift_per_m * travel +
                          dice.normal(options_.yaw_noise_per_root_turn * std::sqrt(std::abs(motion.phi())));
      odom_from_base = odom_from_base +
                       CPose2D(options_.travel_scale * motion.x() + jitter, options_.travel_scale * motion.y(), turn);
    }
    all.push_back({stamp, odom_from_base});
  }
  return all;
}

CObservation::Ptr SimulatedLog::scan(const SimulatedLaser& laser, base::Stamp stamp, Dice& dice) const {
  auto scan = mrpt::obs::CObservation2DRangeScan::Create();
  scan->sensorLabel = laser.label;
  scan->timestamp = stamp;
  scan->sensorPose = laser.base_from_sensor;
  scan->aperture = static_cast<float>(laser.aperture);
  scan->maxRange = static_cast<float>(laser.max_range);
  scan->stdError = static_cast<float>(laser.sigma);
  scan->rightToLeft = true;
  scan->resizeScan(static_cast<std::size_t>(laser.beams));
  CPose3D map_from_sensor = CPose3D(truthAt(stamp)) + laser.base_from_sensor;
  auto rotation = map_from_sensor.getRotationMatrix();
  for (int i = 0; i < laser.beams; ++i) {
    if (laser.sweep > 0) {
      const double seconds = laser.sweep * i / (laser.beams - 1);
      map_from_sensor = CPose3D(truthAt(stamp + base::durationFromSeconds(seconds))) + laser.base_from_sensor;
      rotation = map_from_sensor.getRotationMatrix();
    }
    const double angle = laser.aperture * (static_cast<double>(i) / (laser.beams - 1) - 0.5);
    // Walls are upright, so the range is the distance along the floor, divided by the horizontal part of the beam.
    const Eigen::Vector2d on_floor(rotation(0, 0) * std::cos(angle) + rotation(0, 1) * std::sin(angle),
                                   rotation(1, 0) * std::cos(angle) + rotation(1, 1) * std::sin(angle));
    const double range =
        plan_.distanceToWall({map_from_sensor.x(), map_from_sensor.y()}, on_floor.normalized()) / on_floor.norm();
    const bool valid = range < laser.max_range;
    const double noisy = range + dice.normal(laser.sigma);
    const auto beam = static_cast<std::size_t>(i);
    scan->setScanRange(beam, static_cast<float>(valid ? noisy : laser.max_range));
    scan->setScanRangeValidity(beam, valid);
  }
  return scan;
}

CObservation::Ptr SimulatedLog::fix(base::Stamp stamp, Dice& dice) const {
  const auto& gps = options_.gps;
  const CPose3D antenna_in_enu = gps.enu_from_map + CPose3D(truthAt(stamp)) + gps.antenna;
  const mrpt::topography::TGeodeticCoords origin(gps.latitude, gps.longitude, gps.altitude);
  const mrpt::math::TPoint3D enu(antenna_in_enu.x() + dice.normal(gps.sigma),
                                 antenna_in_enu.y() + dice.normal(gps.sigma), antenna_in_enu.z());
  mrpt::topography::TGeocentricCoords earth_centred;
  mrpt::topography::ENUToGeocentric(enu, origin, earth_centred, mrpt::topography::TEllipsoid::Ellipsoid_WGS84());
  mrpt::topography::TGeodeticCoords here;
  mrpt::topography::geocentricToGeodetic(earth_centred, here, mrpt::topography::TEllipsoid::Ellipsoid_WGS84());

  mrpt::obs::gnss::Message_NMEA_GGA gga;
  gga.fields.latitude_degrees = here.lat;
  gga.fields.longitude_degrees = here.lon;
  gga.fields.altitude_meters = here.height;
  gga.fields.fix_quality = static_cast<std::uint8_t>(gps.quality);
  gga.fields.satellitesUsed = 9;
  gga.fields.thereis_HDOP = true;
  gga.fields.HDOP = 0.9F;
  auto observation = mrpt::obs::CObservationGPS::Create();
  observation->sensorLabel = "gps";
  observation->timestamp = stamp;
  observation->sensorPose = gps.antenna;
  observation->setMsg(gga);
  return observation;
}

CObservation::Ptr SimulatedLog::trackedPose(base::Stamp stamp, Dice& dice) const {
  const auto& tracker = options_.tracker;
  const double x = dice.normal(tracker.sigma), y = dice.normal(tracker.sigma), yaw = dice.normal(tracker.angle_sigma);
  auto observation = mrpt::obs::CObservationRobotPose::Create();
  observation->sensorLabel = "tracker";
  observation->timestamp = stamp;
  observation->sensorPose = tracker.base_from_body;
  observation->pose.mean =
      tracker.reference_from_map + CPose3D(truthAt(stamp)) + tracker.base_from_body + CPose3D(x, y, 0, yaw, 0, 0);
  return observation;
}

std::vector<CObservation::Ptr> SimulatedLog::observations() const {
  std::vector<CObservation::Ptr> all;
  for (const auto& [stamp, odom_from_base] : odometry()) {
    auto observation = mrpt::obs::CObservationOdometry::Create();
    observation->sensorLabel = "odometry";
    observation->timestamp = stamp;
    observation->odometry = odom_from_base;
    all.push_back(observation);
  }
  for (std::size_t i = 0; i < options_.lasers.size(); ++i) {
    const auto& laser = options_.lasers[i];
    Dice dice(options_.seed + 1000 * (i + 1));
    for (const auto stamp : stampsOf(*this, laser.rate, laser.phase)) all.push_back(scan(laser, stamp, dice));
  }
  if (options_.gps.on) {
    Dice dice(options_.seed + 1);
    for (const auto stamp : stampsOf(*this, options_.gps.rate, options_.gps.phase)) all.push_back(fix(stamp, dice));
  }
  if (options_.tracker.on) {
    Dice dice(options_.seed + 2);
    const auto& tracker = options_.tracker;
    for (const auto stamp : stampsOf(*this, tracker.rate, tracker.phase)) all.push_back(trackedPose(stamp, dice));
  }
  if (options_.beacons.on) {
    Dice dice(options_.seed + 3);
    const auto& beacons = options_.beacons;
    for (const auto stamp : stampsOf(*this, beacons.rate, beacons.phase)) {
      const double seconds = base::secondsBetween(begin_, stamp);
      all.push_back(beacons.measurements(plan_, CPose3D(truthAt(stamp)), stamp, seconds, dice));
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
  return all;
}

void SimulatedLog::writeRawlog(const std::string& path, Format format) const {
  mrpt::io::CFileGZOutputStream file;
  if (!file.open(path)) throw std::runtime_error("cannot write " + path);
  auto archive = mrpt::serialization::archiveFrom(file);
  const auto odometry = this->odometry();
  // The motion between two readings of the odometry is interpolated linearly.
  const auto odometryAt = [&](base::Stamp stamp) {
    const auto after = std::find_if(odometry.begin(), odometry.end(), [&](const auto& o) { return o.stamp >= stamp; });
    if (after == odometry.begin()) return after->odom_from_base;
    const auto& before = *std::prev(after);
    if (after == odometry.end()) return before.odom_from_base;
    const double part = base::secondsBetween(before.stamp, stamp) / base::secondsBetween(before.stamp, after->stamp);
    const CPose2D step = after->odom_from_base - before.odom_from_base;
    return before.odom_from_base + CPose2D(part * step.x(), part * step.y(), part * step.phi());
  };
  CPose2D last = odometry.front().odom_from_base;
  for (const auto& observation : observations()) {
    if (format == Format::observations) {
      archive << *observation;
      continue;
    }
    if (IS_CLASS(*observation, mrpt::obs::CObservationOdometry)) continue;
    const CPose2D now = odometryAt(observation->timestamp);
    mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
    model.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
    mrpt::obs::CActionRobotMovement2D movement;
    movement.computeFromOdometry(now - last, model);
    movement.timestamp = observation->timestamp;
    last = now;
    mrpt::obs::CActionCollection actions;
    actions.insert(movement);
    mrpt::obs::CSensoryFrame frame;
    frame.insert(observation);
    archive << actions << frame;
  }
}

void SimulatedLog::writeTruthTum(const std::string& path) const {
  std::ofstream out(path);
  out.precision(9);
  base::Stamp last;
  for (const auto& observation : observations()) {
    if (observation->timestamp == last) continue;
    last = observation->timestamp;
    const CPose2D pose = truthAt(last);
    out << base::formatUnix(last) << ' ' << pose.x() << ' ' << pose.y() << " 0 0 0 " << std::sin(pose.phi() / 2) << ' '
        << std::cos(pose.phi() / 2) << '\n';
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace omnimapper::testing
