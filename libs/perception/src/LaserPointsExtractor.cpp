#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/geometry/FloorHits.h>
#include <omnimapper/perception/LaserPointsExtractor.h>

#include <cmath>
#include <vector>

namespace omnimapper::perception {

namespace {

struct Point {
  float x, y;
};

float distance(const Point& a, const Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

std::vector<Point> validPoints(const mrpt::obs::CObservation2DRangeScan& scan, double min_range, double max_range) {
  std::vector<Point> points;
  const std::size_t beams = scan.getScanSize();
  if (!std::isfinite(scan.aperture)) return points;
  points.reserve(beams);
  const double step = beams > 1 ? scan.aperture / static_cast<double>(beams - 1) : 0.0;
  const double sign = scan.rightToLeft ? 1.0 : -1.0;
  const double first = beams > 1 ? -0.5 * scan.aperture * sign : 0.0;
  const geometry::FloorHits floor(scan.sensorPose);
  for (std::size_t i = 0; i < beams; ++i) {
    const double range = scan.getScanRange(i);
    if (!scan.getScanRangeValidity(i) || !std::isfinite(range) || range < min_range || range > max_range) continue;
    if (range >= scan.maxRange) continue;  // many sensors report this if no echo came back
    const double angle = first + sign * step * static_cast<double>(i);
    const double x = range * std::cos(angle), y = range * std::sin(angle);
    if (!floor.holds(x, y)) points.push_back({static_cast<float>(x), static_cast<float>(y)});
  }
  return points;
}

std::vector<Point> withoutIsolated(const std::vector<Point>& points, double isolated_distance) {
  if (isolated_distance <= 0) return points;
  std::vector<Point> kept;
  kept.reserve(points.size());
  const auto limit = static_cast<float>(isolated_distance);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool near_before = i > 0 && distance(points[i], points[i - 1]) < limit;
    const bool near_after = i + 1 < points.size() && distance(points[i], points[i + 1]) < limit;
    if (near_before || near_after) kept.push_back(points[i]);
  }
  // Points on far walls are isolated, too, if the angular steps are coarse. If most points would
  // be dropped, the steps are taken to be coarse, and all points are kept.
  return 2 * kept.size() >= points.size() ? kept : points;
}

std::vector<Point> spaced(const std::vector<Point>& points, double spacing) {
  if (spacing <= 0) return points;
  std::vector<Point> kept;
  for (const auto& point : points) {
    if (kept.empty() || distance(point, kept.back()) >= static_cast<float>(spacing)) kept.push_back(point);
  }
  return kept;
}

}  // namespace

const base::OptionTable<LaserPointsOptions>& LaserPointsOptions::table() {
  using Options = LaserPointsOptions;
  static const auto table =
      base::OptionTable<Options>()
          .number("min_range_m", &Options::min_range, base::Range::notNegative(),
                  "Readings nearer than this are dropped.")
          .number("max_range_m", &Options::max_range, base::Range::positive(),
                  "Readings farther than this are dropped.")
          .number("spacing_m", &Options::spacing, base::Range::notNegative(),
                  "Smallest distance between successive points that are kept of a scan; 0 keeps all points.")
          .number("isolated_distance_m", &Options::isolated_distance, base::Range::notNegative(),
                  "A point that is farther than this from both of its neighbours is dropped, because its beam probably "
                  "hit both the edge of something and what is behind that edge; 0 keeps all points.");
  return table;
}

mrpt::obs::CObservation::Ptr LaserPointsExtractor::extract(const mrpt::obs::CObservation2DRangeScan& scan) const {
  const auto valid = validPoints(scan, options_.min_range, options_.max_range);
  const auto points = spaced(withoutIsolated(valid, options_.isolated_distance), options_.spacing);
  auto cloud = mrpt::maps::CSimplePointsMap::Create();
  cloud->reserve(points.size());
  for (const auto& point : points) cloud->insertPointFast(point.x, point.y, 0);
  auto derived = mrpt::obs::CObservationPointCloud::Create();
  derived->pointcloud = cloud;
  derived->sensorPose = scan.sensorPose;
  derived->timestamp = scan.timestamp;
  derived->sensorLabel = labelOf(scan.sensorLabel);
  return derived;
}

bool LaserPointsExtractor::made(const mrpt::obs::CObservation& observation) {
  if (!dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation)) return false;
  const std::string &label = observation.sensorLabel, end = labelOf("");
  return label.size() >= end.size() && label.compare(label.size() - end.size(), end.size(), end) == 0;
}

bool LaserPointsExtractor::wants(const mrpt::obs::CObservation& raw) const {
  return dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&raw) != nullptr;
}

std::vector<mrpt::obs::CObservation::Ptr> LaserPointsExtractor::extract(const mrpt::obs::CObservation& raw) const {
  return {extract(dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(raw))};
}

std::vector<DerivedName> LaserPointsExtractor::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(mrpt::obs::CObservationPointCloud), labelOf(raw.sensorLabel)}};
}

}  // namespace omnimapper::perception
