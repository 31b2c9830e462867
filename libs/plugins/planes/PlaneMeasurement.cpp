#include "PlaneMeasurement.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/ConvexPolygon2.h>
#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/geometry/PolygonBooleans.h>
#include <omnimapper/geometry/Simplify.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/plane_factors/PlaneFactors.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "PlaneExtent.h"

namespace omnimapper::plugins {

namespace {

using geometry::Plane3;
using geometry::Se3;

bool allFinite(const std::vector<Eigen::Vector3d>& points) {
  return std::all_of(points.begin(), points.end(), [](const auto& point) { return point.allFinite(); });
}

bool isCovariance(const Eigen::MatrixXd& matrix) {
  return matrix.allFinite() && Eigen::LLT<Eigen::MatrixXd>(matrix).info() == Eigen::Success;
}

constexpr const char* kNoCovariance = "its covariance is singular or not finite";

PlaneMeasurement useless(PlaneMeasurement measurement, std::string why) {
  measurement.why_useless = std::move(why);
  return measurement;
}

// Outlines follow pixels, so most of their corners carry no information about a wall.
std::vector<Eigen::Vector3d> withoutNeedlessCorners(const std::vector<Eigen::Vector3d>& walk,
                                                    const plane_factors::PlaneAxes& axes) {
  constexpr double kStraight = 0.01;  // [m]
  std::vector<Eigen::Vector2d> dropped;
  for (const auto& point : walk) dropped.push_back(axes.onto(point));
  std::vector<Eigen::Vector3d> kept;
  for (const std::size_t i : geometry::keptOfLoop(dropped, kStraight)) kept.push_back(walk[i]);
  return kept;
}

// The well seen points of a plane lie in a disc about the foot of the perpendicular from the sensor.
struct Disc {
  Eigen::Vector2d middle;
  double radius;
  bool contains(const Eigen::Vector2d& point) const { return (point - middle).norm() <= radius; }
  std::vector<Eigen::Vector2d> asPolygon() const {
    constexpr int kCorners = 64;
    std::vector<Eigen::Vector2d> corners;
    for (int i = 0; i < kCorners; ++i) {
      const double angle = 2 * M_PI * i / kCorners;
      corners.push_back(middle + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    return corners;
  }
};

Disc wellSeenOn(const plane_factors::PlaneAxes& axes, const Plane3& plane, const Eigen::Vector3d& sensor,
                const PlaneLandmarksOptions& options) {
  const double off = std::abs(signedDistance(plane, sensor));
  const double near = options.well_seen_within * options.well_seen_within - off * off;
  const double aslant = off * std::tan(std::min(options.well_seen_under, M_PI / 2 - 1e-6));
  return {axes.onto(sensor), std::min(near > 0 ? std::sqrt(near) : 0, aslant)};
}

// Leaves `well_seen_in_base` empty if the whole plane is well seen.
void addWellSeen(const plane_factors::PlaneAxes& axes, const Disc& disc, PlaneMeasurement& measurement) {
  const auto dropped = [&](const std::vector<Eigen::Vector3d>& walk) {
    std::vector<Eigen::Vector2d> points;
    for (const auto& corner : walk) points.push_back(axes.onto(corner));
    return points;
  };
  const geometry::HoledPolygon2 whole{dropped(measurement.outline_in_base), [&] {
                                        std::vector<std::vector<Eigen::Vector2d>> holes;
                                        for (const auto& hole : measurement.holes_in_base)
                                          holes.push_back(dropped(hole));
                                        return holes;
                                      }()};
  measurement.is_all_well_seen = std::all_of(whole.outline.begin(), whole.outline.end(),
                                             [&](const auto& corner) { return disc.contains(corner); });
  if (measurement.is_all_well_seen || !(disc.radius > 0)) return;
  const geometry::Areas2 areas = geometry::intersectionOf(whole, disc.asPolygon());
  const auto inSpace = [&](const std::vector<Eigen::Vector2d>& walk) {
    std::vector<Eigen::Vector3d> corners;
    for (const auto& corner : walk) corners.push_back(axes.inSpace(corner));
    return corners;
  };
  // Areas2 does not assign holes to outlines: each of several outlines gets all of them.
  for (const auto& outline : areas.outlines) {
    surfaces::FlatPart& part = measurement.well_seen_in_base.emplace_back();
    part.outline = inSpace(outline);
    for (const auto& hole : areas.holes) part.holes.push_back(inSpace(hole));
  }
}

PlaneMeasurement ofPlane(const obs::ObservedPlane& measured, const Se3& base_from_sensor,
                         const PlaneLandmarksOptions& options) {
  const Plane3& in_sensor = measured.plane_in_sensor;
  PlaneMeasurement measurement;
  const bool usable = in_sensor.normal.allFinite() && std::abs(in_sensor.normal.norm() - 1) < 1e-3 &&
                      std::isfinite(in_sensor.distance) && measured.centroid.allFinite() &&
                      allFinite(measured.outline.vertices);
  if (!usable) return useless(measurement, "not finite");
  const Eigen::Matrix3d covariance =
      withRoughness(in_sensor, measured.covariance, measured.centroid, options.plane_angle_sigma, options.plane_sigma);
  if (!isCovariance(covariance)) return useless(measurement, kNoCovariance);
  const Plane3 in_base = base_from_sensor * Plane3{in_sensor.normal.normalized(), in_sensor.distance};
  const Eigen::Matrix3d in_base_covariance = geometry::transportCovariance(base_from_sensor, in_sensor, covariance);
  std::vector<Eigen::Vector3d> corners;
  for (const auto& vertex : measured.outline.vertices) corners.push_back(base_from_sensor * vertex);
  const plane_factors::PlaneAxes axes(in_base);
  const auto hull = hullOn(axes, corners);
  if (hull.size() < 3) return useless(measurement, "its outline has no area");
  measurement.plane_in_base = in_base;
  if (options.boundary == PlaneLandmarksOptions::Boundary::seen) {
    measurement.outline_in_base = withoutNeedlessCorners(corners, axes);
    for (const auto& hole : measured.holes) {
      if (!allFinite(hole.vertices)) continue;
      std::vector<Eigen::Vector3d> walk;
      for (const auto& vertex : hole.vertices) walk.push_back(base_from_sensor * vertex);
      measurement.holes_in_base.push_back(withoutNeedlessCorners(walk, axes));
    }
    addWellSeen(axes, wellSeenOn(axes, in_base, base_from_sensor.translation, options), measurement);
  } else {
    for (const auto& corner : hull) measurement.outline_in_base.push_back(axes.inSpace(corner));
  }
  measurement.size = geometry::area(hull);
  measurement.roughness = std::isfinite(measured.roughness) ? measured.roughness : 0;
  measurement.factor = std::make_shared<plane_factors::PlaneFactor>(in_base);
  measurement.noise = graph::SquareRootInformation::fromCovariance(in_base_covariance);
  return measurement;
}

// The line x cos a + y sin a = d of the scan, with its middle at s along e = (-sin a, cos a): errors of a and d
// turn e by -da against the normal, and move the middle by dd - s da (doc/derivations/line_on_plane.md).
PlaneMeasurement ofLine(const obs::LaserLine& measured, const Se3& base_from_sensor, const Eigen::Vector3d& up_in_base,
                        const plane_factors::PlaneParametrization& form, const PlaneLandmarksOptions& options) {
  PlaneMeasurement measurement;
  measurement.is_line = true;
  measurement.size = geometry::length(measured.segment_in_sensor);
  const Eigen::Vector2d along = geometry::direction(measured.segment_in_sensor);
  const Eigen::Vector2d middle = geometry::middle(measured.segment_in_sensor);
  if (!along.allFinite() || !middle.allFinite()) return useless(measurement, "not finite");
  if (!(measurement.size > 0)) return useless(measurement, "its ends are one point");
  const Eigen::Vector2d by_angle(-std::sin(measured.angle), std::cos(measured.angle));
  const double s = middle.dot(by_angle);
  Eigen::Matrix2d by_line;
  by_line << -1, 0, -s, 1;
  Eigen::Matrix2d covariance = by_line * measured.covariance * by_line.transpose();
  covariance(0, 0) += options.line_angle_sigma * options.line_angle_sigma;
  covariance(1, 1) += options.line_sigma * options.line_sigma;
  if (!isCovariance(covariance)) return useless(measurement, kNoCovariance);
  const auto inBase = [&](const Eigen::Vector2d& point) -> Eigen::Vector3d {
    return base_from_sensor * Eigen::Vector3d(point.x(), point.y(), 0);
  };
  Eigen::Vector3d direction = base_from_sensor.rotation * Eigen::Vector3d(along.x(), along.y(), 0);
  Eigen::Vector3d normal = up_in_base.cross(direction);
  if (normal.norm() < 0.5) return useless(measurement, "the scan is not level: no upright plane follows from its line");
  normal.normalize();
  const Eigen::Vector3d from_wall = base_from_sensor.translation - inBase(middle);
  if (normal.dot(from_wall) < 0) {
    normal = -normal;  // the free side is on the left of the direction
    direction = -direction;
  }
  const Eigen::Vector3d by_angle_in_base = base_from_sensor.rotation * Eigen::Vector3d(by_angle.x(), by_angle.y(), 0);
  if (direction.dot(by_angle_in_base) < 0) covariance(0, 1) = covariance(1, 0) = -covariance(0, 1);
  measurement.plane_in_base = Plane3::through(inBase(middle), normal);
  measurement.outline_in_base = {inBase(measured.segment_in_sensor.from), inBase(measured.segment_in_sensor.to)};
  measurement.factor = form.ofLine(direction, inBase(middle));
  measurement.noise = graph::SquareRootInformation::fromCovariance(covariance);
  return measurement;
}

}  // namespace

Eigen::Matrix3d withRoughness(const Plane3& plane, const Eigen::Matrix3d& covariance, const Eigen::Vector3d& middle,
                              double angle_sigma, double distance_sigma) {
  const Se3 middle_from_here{Eigen::Quaterniond::Identity(), -middle}, here_from_middle = inverse(middle_from_here);
  Eigen::Matrix3d about_middle = geometry::transportCovariance(middle_from_here, plane, covariance);
  about_middle.diagonal() +=
      Eigen::Vector3d(angle_sigma * angle_sigma, angle_sigma * angle_sigma, distance_sigma * distance_sigma);
  return geometry::transportCovariance(here_from_middle, middle_from_here * plane, about_middle);
}

std::vector<PlaneMeasurement> planeMeasurements(const mrpt::obs::CObservation& observation,
                                                const Eigen::Vector3d& up_in_base,
                                                const plane_factors::PlaneParametrization& form,
                                                const PlaneLandmarksOptions& options) {
  std::vector<PlaneMeasurement> measurements;
  const auto take = [&](PlaneMeasurement measurement, const std::string& label) {
    measurement.sensor_label = label;
    measurements.push_back(std::move(measurement));
  };
  if (const auto* planes = dynamic_cast<const obs::CObservationPlanes*>(&observation)) {
    const Se3 base_from_sensor = geometry::fromMrpt(planes->sensorPose);
    for (const auto& plane : planes->planes) take(ofPlane(plane, base_from_sensor, options), planes->source_label);
  } else if (const auto* lines = dynamic_cast<const obs::CObservationLaserLines*>(&observation)) {
    const Se3 base_from_sensor = geometry::fromMrpt(lines->sensorPose);
    for (const auto& line : lines->lines)
      take(ofLine(line, base_from_sensor, up_in_base, form, options), lines->source_label);
  }
  return measurements;
}

}  // namespace omnimapper::plugins
