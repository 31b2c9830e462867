#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/obs/CObservationRelativeMotion.h>
#include <omnimapper/testing/DeclaredFaults.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>

namespace omnimapper::testing {

namespace {

using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservation3DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::poses::CPose3D;
using obs::CObservationRelativeMotion;
using Log = std::vector<mrpt::obs::CObservation::Ptr>;

constexpr double kDegree = 3.14159265358979323846 / 180;

template <class Class>
Log changed(const Log& log, const std::function<void(Class&)>& change) {
  Log copies;
  for (const auto& observation : log) {
    if (!dynamic_cast<const Class*>(observation.get())) {
      copies.push_back(observation);
      continue;
    }
    auto copy = std::dynamic_pointer_cast<mrpt::obs::CObservation>(observation->duplicateGetSmartPtr());
    change(dynamic_cast<Class&>(*copy));
    copies.push_back(std::move(copy));
  }
  return copies;
}

Log sorted(Log log) {
  std::stable_sort(log.begin(), log.end(), [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
  return log;
}

void clip(CObservation2DRangeScan& scan, double limit) {
  for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
    if (scan.getScanRange(i) < limit) continue;
    scan.setScanRange(i, static_cast<float>(limit));
    scan.setScanRangeValidity(i, true);
  }
}

Log frozen(const Log& log, double share) {
  constexpr double kSpan = 3;  // [s]
  std::map<std::string, std::shared_ptr<CObservation2DRangeScan>> last;
  const auto start = log.front()->timestamp;
  return changed<CObservation2DRangeScan>(log, [&](CObservation2DRangeScan& scan) {
    const double seconds = base::secondsBetween(start, scan.timestamp);
    const bool is_frozen = std::fmod(seconds, kSpan / share) > kSpan / share - kSpan;
    auto& shown = last[scan.sensorLabel];
    if (is_frozen && shown && shown->getScanSize() == scan.getScanSize()) {
      for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
        scan.setScanRange(i, shown->getScanRange(i));
        scan.setScanRangeValidity(i, shown->getScanRangeValidity(i));
      }
    } else {
      shown = std::make_shared<CObservation2DRangeScan>(scan);
    }
  });
}

Log withMaximumReadings(const Log& log, double share) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  return changed<CObservation2DRangeScan>(log, [&](CObservation2DRangeScan& scan) {
    for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
      if (uniform(generator) >= share) continue;
      scan.setScanRange(i, scan.maxRange);
      scan.setScanRangeValidity(i, true);
    }
  });
}

Log withLeftForRight(const Log& log) {
  const auto turned = changed<CObservationOdometry>(log, [](CObservationOdometry& odometry) {
    const auto& p = odometry.odometry;
    odometry.odometry = mrpt::poses::CPose2D(p.x(), -p.y(), -p.phi());
  });
  return changed<CObservationRelativeMotion>(turned, [](CObservationRelativeMotion& motion) {
    const auto& p = motion.begin_from_end;
    motion.begin_from_end = CPose3D(p.x(), -p.y(), p.z(), -p.yaw(), p.pitch(), p.roll());
  });
}

Log withLateWheels(const Log& log, double seconds) {
  const auto late = base::durationFromSeconds(seconds);
  auto changes = changed<CObservationOdometry>(log, [&](CObservationOdometry& one) { one.timestamp += late; });
  changes = changed<CObservationRelativeMotion>(changes, [&](CObservationRelativeMotion& one) {
    one.timestamp += late;
    one.begin += late;
  });
  return sorted(std::move(changes));
}

void mirror(CObservation3DRangeScan& image) {
  auto& pixels = image.rangeImage;
  for (int row = 0; row < pixels.rows(); ++row) {
    for (int column = 0; 2 * column < pixels.cols(); ++column)
      std::swap(pixels(row, column), pixels(row, pixels.cols() - 1 - column));
  }
  if (image.hasIntensityImage) image.intensityImage.flipHorizontal();
}

void makeRanges(CObservation3DRangeScan& image) {
  const auto& camera = image.cameraParams;
  auto& pixels = image.rangeImage;
  for (int row = 0; row < pixels.rows(); ++row) {
    for (int column = 0; column < pixels.cols(); ++column) {
      const double x = (column - camera.cx()) / camera.fx(), y = (row - camera.cy()) / camera.fy();
      const double range = pixels(row, column) * std::sqrt(1 + x * x + y * y);
      pixels(row, column) = static_cast<std::uint16_t>(std::min(65535.0, range));
    }
  }
}

void scaleFocalLength(CObservation3DRangeScan& image, double factor) {
  for (auto* camera : {&image.cameraParams, &image.cameraParamsIntensity}) {
    camera->fx(camera->fx() * factor);
    camera->fy(camera->fy() * factor);
  }
}

void turnAboutZ(CPose3D& pose, double yaw) {
  pose = CPose3D(pose.x(), pose.y(), pose.z(), pose.yaw() + yaw, pose.pitch(), pose.roll());
}

}  // namespace

std::string nameOf(DeclaredFault kind) {
  static const std::map<DeclaredFault, std::string> names{
      {DeclaredFault::laser_sense, "laser's sense"},       {DeclaredFault::laser_roll, "laser's roll"},
      {DeclaredFault::laser_yaw, "laser's yaw"},           {DeclaredFault::range_limit, "range limit"},
      {DeclaredFault::frozen_scans, "frozen scans"},       {DeclaredFault::maximum_readings, "maximum readings"},
      {DeclaredFault::wheels_left_right, "wheels' sign"},  {DeclaredFault::wheels_clock, "wheels' clock"},
      {DeclaredFault::camera_yaw, "camera's yaw"},         {DeclaredFault::camera_roll, "camera's roll"},
      {DeclaredFault::depth_scale, "depth scale"},         {DeclaredFault::focal_length, "focal length"},
      {DeclaredFault::mirrored_images, "mirrored images"}, {DeclaredFault::ranges_as_depths, "ranges as depths"},
      {DeclaredFault::camera_clock, "camera's clock"},     {DeclaredFault::stamps, "stamps"},
  };
  return names.at(kind);
}

bool isOfCamera(DeclaredFault kind) {
  switch (kind) {
    case DeclaredFault::camera_yaw:
    case DeclaredFault::camera_roll:
    case DeclaredFault::depth_scale:
    case DeclaredFault::focal_length:
    case DeclaredFault::mirrored_images:
    case DeclaredFault::ranges_as_depths:
    case DeclaredFault::camera_clock:
      return true;
    default:
      return false;
  }
}

const std::vector<DeclaredFault>& allDeclaredFaults() {
  static const std::vector<DeclaredFault> all = [] {
    std::vector<DeclaredFault> kinds;
    for (int i = 0; i <= static_cast<int>(DeclaredFault::stamps); ++i) kinds.push_back(static_cast<DeclaredFault>(i));
    return kinds;
  }();
  return all;
}

std::vector<Fault> gradesOf(DeclaredFault kind) {
  const auto graded = [&](const std::vector<double>& little, const std::vector<double>& gross) {
    std::vector<Fault> faults;
    for (const double amount : little) faults.push_back({kind, amount, false});
    for (const double amount : gross) faults.push_back({kind, amount, true});
    return faults;
  };
  switch (kind) {
    case DeclaredFault::laser_yaw:
      return graded({1, 3, -6}, {12, -20, 45, -90, 180});
    case DeclaredFault::range_limit:
      return graded({20, 12}, {6, 4, 3});
    case DeclaredFault::frozen_scans:
      return graded({0.05}, {0.2, 0.35});
    case DeclaredFault::maximum_readings:
      return graded({0.001, 0.01}, {0.03, 0.1});
    case DeclaredFault::wheels_clock:
      return graded({0.03, -0.1}, {0.6, -1.5, 4.3, -20, 100});
    case DeclaredFault::camera_yaw:
      return graded({0.5, -2}, {5, -10, 25, -60});
    case DeclaredFault::camera_roll:
      return graded({1, -3}, {8, -15, 90, 180});
    case DeclaredFault::depth_scale:
      return graded({1.01, 0.97}, {1.2, 0.2, 5, 0.001, 1000});
    case DeclaredFault::focal_length:
      return graded({1.02, 0.95}, {1.15, 0.8, 1.3});
    case DeclaredFault::camera_clock:
      return graded({0.03, -0.06}, {0.15, -0.3, 1, -2.5});
    case DeclaredFault::stamps:
      return graded({}, {0, 1});
    default:
      return graded({}, {1});
  }
}

std::vector<mrpt::obs::CObservation::Ptr> withFault(const std::vector<mrpt::obs::CObservation::Ptr>& log,
                                                    const Fault& fault) {
  const double amount = fault.amount;
  switch (fault.kind) {
    case DeclaredFault::laser_sense:
      return changed<CObservation2DRangeScan>(log, [](auto& scan) { scan.rightToLeft = !scan.rightToLeft; });
    case DeclaredFault::laser_roll:
      return changed<CObservation2DRangeScan>(
          log, [](auto& scan) { scan.sensorPose = scan.sensorPose + CPose3D(0, 0, 0, 0, 0, 180 * kDegree); });
    case DeclaredFault::laser_yaw:
      return changed<CObservation2DRangeScan>(log, [&](auto& scan) { turnAboutZ(scan.sensorPose, amount * kDegree); });
    case DeclaredFault::range_limit:
      return changed<CObservation2DRangeScan>(log, [&](auto& scan) { clip(scan, amount); });
    case DeclaredFault::frozen_scans:
      return frozen(log, amount);
    case DeclaredFault::maximum_readings:
      return withMaximumReadings(log, amount);
    case DeclaredFault::wheels_left_right:
      return withLeftForRight(log);
    case DeclaredFault::wheels_clock:
      return withLateWheels(log, amount);
    case DeclaredFault::camera_yaw:
      return changed<CObservation3DRangeScan>(log, [&](auto& one) { turnAboutZ(one.sensorPose, amount * kDegree); });
    case DeclaredFault::camera_roll:
      return changed<CObservation3DRangeScan>(
          log, [&](auto& one) { one.sensorPose = one.sensorPose + CPose3D(0, 0, 0, 0, 0, amount * kDegree); });
    case DeclaredFault::depth_scale:
      return changed<CObservation3DRangeScan>(log, [&](auto& one) { one.rangeUnits *= static_cast<float>(amount); });
    case DeclaredFault::focal_length:
      return changed<CObservation3DRangeScan>(log, [&](auto& one) { scaleFocalLength(one, amount); });
    case DeclaredFault::mirrored_images:
      return changed<CObservation3DRangeScan>(log, mirror);
    case DeclaredFault::ranges_as_depths:
      return changed<CObservation3DRangeScan>(log, makeRanges);
    case DeclaredFault::camera_clock:
      return sorted(changed<CObservation3DRangeScan>(
          log, [&](auto& one) { one.timestamp += base::durationFromSeconds(amount); }));
    case DeclaredFault::stamps:
      return changed<mrpt::obs::CObservation>(
          log, [&](auto& one) { one.timestamp = amount > 0 ? log.front()->timestamp : base::Stamp(); });
  }
  return log;
}

}  // namespace omnimapper::testing
