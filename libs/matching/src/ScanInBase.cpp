#include <omnimapper/matching/ScanInBase.h>
#include <omnimapper/matching/Things.h>
#include <omnimapper/matching/deskew.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace omnimapper::matching {

namespace {

struct Points {
  std::vector<Eigen::Vector2f> in_base;
  std::vector<float> directions;  // [rad] in the sensor's frame
};

Points pointsOf(const mrpt::obs::CObservationPointCloud& cloud) {
  Points points;
  points.in_base.reserve(cloud.pointcloud->size());
  points.directions.reserve(cloud.pointcloud->size());
  const auto rotation = cloud.sensorPose.getRotationMatrix().asEigen();
  const double tx = cloud.sensorPose.x(), ty = cloud.sensorPose.y();
  for (std::size_t i = 0; i < cloud.pointcloud->size(); ++i) {
    float x, y, z;
    cloud.pointcloud->getPointFast(i, x, y, z);
    const double bx = tx + rotation(0, 0) * x + rotation(0, 1) * y + rotation(0, 2) * z;
    const double by = ty + rotation(1, 0) * x + rotation(1, 1) * y + rotation(1, 2) * z;
    if (!std::isfinite(bx) || !std::isfinite(by)) continue;
    points.in_base.emplace_back(bx, by);
    points.directions.push_back(std::atan2(y, x));
  }
  return points;
}

// Position of the laser on the base [m].
Eigen::Vector2f placeOf(const mrpt::obs::CObservationPointCloud& cloud) {
  return {static_cast<float>(cloud.sensorPose.x()), static_cast<float>(cloud.sensorPose.y())};
}

}  // namespace

double tiltOf(const mrpt::poses::CPose3D& base_from_sensor) {
  return std::acos(std::min(1.0, std::abs(base_from_sensor.getRotationMatrix()(2, 2))));
}

ScanWithNormals scanInBase(const mrpt::obs::CObservationPointCloud& cloud) {
  return fitLines(pointsOf(cloud).in_base);
}

std::vector<Eigen::Vector2f> pointsInBase(const mrpt::obs::CObservationPointCloud& cloud) {
  return pointsOf(cloud).in_base;
}

namespace {

// The noise is that of the points before they are moved onto lines.
ScanWithNormals withThings(const std::vector<Eigen::Vector2f>& points, const mrpt::obs::CObservationPointCloud& cloud) {
  auto scan = fitLines(points);
  scan.things = numberThings(scan.points, placeOf(cloud), rangeNoise(points));
  return scan;
}

}  // namespace

ScanWithNormals scanInBaseWithThings(const mrpt::obs::CObservationPointCloud& cloud) {
  return withThings(pointsInBase(cloud), cloud);
}

ScanWithNormals scanInBaseWithThings(const mrpt::obs::CObservationPointCloud& cloud, const ScanSweep& sweep) {
  const auto points = pointsOf(cloud);
  auto fractions = points.directions;
  const double per_angle = sweep.aperture > 0 ? (sweep.right_to_left ? 1 : -1) / sweep.aperture : 0;
  for (auto& value : fractions) value = static_cast<float>(std::clamp(per_angle * value, -0.5, 0.5));
  return withThings(deskew(points.in_base, fractions, sweep.begin_from_end), cloud);
}

}  // namespace omnimapper::matching
