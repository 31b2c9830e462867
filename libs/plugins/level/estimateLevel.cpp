#include "estimateLevel.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/map/DenseTrajectory.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/plugin/LandmarkShape.h>
#include <omnimapper/surfaces/levelOfSurfaces.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace omnimapper::plugins {

namespace {

using Eigen::Vector3d;
using map::Level;

constexpr double kDegree = geometry::kPi / 180;

std::string degrees(double angle) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f deg", angle / kDegree);
  return text;
}

double angleBetween(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Rotation of the base at a stamp within a session; none outside of it, and none where the neighbouring poses are far
// apart in time and differ in rotation.
class Rotations {
 public:
  explicit Rotations(std::vector<map::StampedPose> poses) : poses_(std::move(poses)) {
    std::stable_sort(poses_.begin(), poses_.end(), [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  }
  std::optional<Eigen::Quaterniond> at(base::Stamp stamp) const {
    constexpr double kFarthest = 3, kStill = 2 * kDegree;  // [s], [rad]
    const auto after =
        std::lower_bound(poses_.begin(), poses_.end(), stamp,
                         [](const map::StampedPose& pose, base::Stamp when) { return pose.stamp < when; });
    if (after == poses_.end() || (after == poses_.begin() && after->stamp != stamp)) return std::nullopt;
    const auto late = geometry::fromMrpt(after->map_from_base).rotation;
    if (after->stamp == stamp) return late;
    const auto before = std::prev(after);
    const auto early = geometry::fromMrpt(before->map_from_base).rotation;
    const double seconds = base::secondsBetween(before->stamp, after->stamp);
    if (seconds > kFarthest && early.angularDistance(late) > kStill) return std::nullopt;
    return early.slerp(base::secondsBetween(before->stamp, stamp) / seconds, late);
  }

 private:
  std::vector<map::StampedPose> poses_;
};

// The level by the inertial sensor with the smallest covariance; the reason names its label.
Level byGravity(const map::Map& map, const LevelEvidence& evidence) {
  Level level;
  if (evidence.imus().empty() || map.sessions.empty()) return level;
  auto trajectory = map::denseTrajectory(map);
  const auto session = map.sessions.back().number;
  trajectory.erase(std::remove_if(trajectory.begin(), trajectory.end(),
                                  [&](const map::StampedPose& pose) { return pose.session != session; }),
                   trajectory.end());
  const Rotations rotations(std::move(trajectory));
  for (const auto& [label, spans] : evidence.imus()) {
    std::vector<motion::RotatedSpan> rotated;
    for (const auto& span : spans.all()) {
      if (const auto map_from_base = rotations.at(span.stamp)) rotated.push_back({*map_from_base, span});
    }
    const auto gravity = motion::gravityOf(rotated);
    const std::string reason = "'" + label + "': " + gravity.reason;
    if (!gravity.up) {
      if (!level.isKnown()) level.reason += (level.reason.empty() ? "" : "; ") + reason;
      continue;
    }
    if (level.isKnown() && level.covariance.trace() <= gravity.covariance.trace()) continue;
    level = {Level::Source::imu, *gravity.up, gravity.covariance, reason};
  }
  return level;
}

// The poses of the cameras, or of the base if there are no cameras.
std::vector<surfaces::Viewpoint> viewpointsOf(const map::Map& map) {
  std::vector<surfaces::Viewpoint> viewpoints;
  const auto add = [&](const geometry::Se3& pose) {
    viewpoints.push_back({pose.translation, pose.rotation * Vector3d::UnitZ(), pose.rotation * Vector3d::UnitX()});
  };
  for (const auto& frame : map.key_frames) {
    for (const auto& observation : frame.observations) {
      const bool is_camera = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(observation.get()) ||
                             dynamic_cast<const obs::CObservationPlanes*>(observation.get());
      if (!is_camera) continue;
      mrpt::poses::CPose3D base_from_sensor;
      observation->getSensorPose(base_from_sensor);
      add(geometry::fromMrpt(frame.map_from_base + base_from_sensor));
      break;
    }
  }
  if (viewpoints.empty())
    for (const auto& frame : map.key_frames) add(geometry::fromMrpt(frame.map_from_base));
  return viewpoints;
}

// The landmarks with surfaces, without those that were measured only once, which may be noise.
std::vector<surfaces::FlatArea> areasOf(const mapper::State& state) {
  constexpr std::uint32_t kFewest = 2;  // measurements
  std::vector<surfaces::FlatArea> areas;
  for (const auto& [id, landmark] : state.map.landmarks) {
    if (landmark.state != map::Landmark::State::active || landmark.evidence < kFewest) continue;
    const auto shape = mapper::shapeOf(landmark, state);
    if (!shape.normal || shape.surfaces.empty()) continue;
    surfaces::FlatArea area{*shape.normal, Vector3d::Zero(), 0, static_cast<int>(landmark.evidence)};
    for (const auto& outline : shape.surfaces) {
      Vector3d middle = Vector3d::Zero();
      for (const auto& vertex : outline.vertices) middle += vertex / static_cast<double>(outline.vertices.size());
      area.middle += geometry::area(outline) * middle;
      area.area += geometry::area(outline);
    }
    if (area.area > 0) area.middle /= area.area;
    for (const auto& hole : shape.holes) area.area -= geometry::area(hole);
    areas.push_back(area);
  }
  return areas;
}

Level bySurfaces(const mapper::State& state, double& margin) {
  Level level;
  const auto areas = areasOf(state);
  const auto estimate = surfaces::levelOfSurfaces(areas, viewpointsOf(state.map));
  margin = estimate.margin;
  level.reason = estimate.reason;
  if (estimate.up) level = {Level::Source::planes, *estimate.up, estimate.covariance, estimate.reason};
  return level;
}

Level byBase(const map::Map& map, const LevelEvidence& evidence, mapper::Motion motion, double sigma) {
  Level level;
  const bool is_planar = motion == mapper::Motion::planar;
  if ((evidence.levelBase().empty() && !is_planar) || map.key_frames.empty()) {
    level.reason = "neither wheel odometry nor a level 2D laser shows that the base is level";
    return level;
  }
  Vector3d sum = Vector3d::Zero();
  for (const auto& frame : map.key_frames) sum += geometry::fromMrpt(frame.map_from_base).rotation * Vector3d::UnitZ();
  level.source = Level::Source::base;
  level.up = is_planar ? Vector3d::UnitZ() : Vector3d(sum.normalized());
  level.covariance = sigma * sigma * (Eigen::Matrix3d::Identity() - level.up * level.up.transpose());
  level.reason = evidence.levelBase().empty() ? "[mapper] motion = planar: the base is level"
                                              : evidence.levelBase() + ": a robot on wheels, whose base is level";
  return level;
}

// Whether two levels differ by more than their standard deviations explain.
bool contradict(const Level& a, const Level& b) {
  constexpr double kSigmas = 3, kLeast = 3 * kDegree;
  const double sigma = std::hypot(a.standardDeviation(), b.standardDeviation());
  return angleBetween(a.up, b.up) > std::max(kLeast, kSigmas * sigma);
}

// A clause that says by how much `other` (gravity or surfaces) differs.
std::string otherwise(const Level& of, const Level& other) {
  return std::string("the up direction by ") + (other.source == Level::Source::imu ? "gravity" : "surfaces") +
         " differs by " + degrees(angleBetween(of.up, other.up));
}

// Combines both, weighted by their covariances.
Level fused(const Level& imu, const Level& planes) {
  Eigen::Matrix<double, 3, 2> tangent;
  tangent.col(0) = imu.up.unitOrthogonal();
  tangent.col(1) = imu.up.cross(tangent.col(0));
  const auto inTangent = [&](const Level& level) -> Eigen::Matrix2d {
    return (tangent.transpose() * level.covariance * tangent).inverse();
  };
  const Eigen::Matrix2d by_imu = inTangent(imu), by_planes = inTangent(planes);
  const Eigen::Matrix2d covariance = (by_imu + by_planes).inverse();
  const Vector3d turn = tangent * (covariance * by_planes * (tangent.transpose() * imu.up.cross(planes.up)));
  Level level = by_imu.trace() > by_planes.trace() ? imu : planes;
  level.up = (geometry::expSo3(turn) * imu.up).normalized();
  level.covariance = tangent * covariance * tangent.transpose();
  level.reason = imu.reason + ", combined with surfaces, which differ by " + degrees(angleBetween(imu.up, planes.up)) +
                 " (" + planes.reason + ")";
  return level;
}

// The base is taken as level unless the measurements clearly show a tilt. A tilt of 30 deg or more is not believed:
// floors and walls are then probably mistaken for each other.
JudgedLevel judgedWithBase(Level base, const std::vector<const Level*>& measured, double base_sigma) {
  constexpr double kMostTilt = 30 * kDegree;
  JudgedLevel judged{base, {}};
  for (const Level* other : measured) {
    if (!other->isKnown()) continue;
    const double angle = angleBetween(base.up, other->up);
    if (!contradict(base, *other)) {
      judged.level = base;
      judged.level.reason += ", and " + otherwise(base, *other);
      judged.warnings.clear();
      const double variance =
          std::min(std::pow(base_sigma, 2), angle * angle + std::pow(other->standardDeviation(), 2));
      judged.level.covariance *= variance / (base_sigma * base_sigma);
      return judged;
    }
    const std::string sentence = "the base is not level: by " + toString(other->source) + " it is tilted by " +
                                 degrees(angle) + " against the map's z (" + other->reason + ")";
    if (angle < kMostTilt && judged.level.source == Level::Source::base) {
      judged.level = *other;
      judged.warnings.push_back(sentence +
                                "; surfaces are judged by the measured up direction. If the sensor's pose on the base "
                                "is wrong, give the right one in [mapper] sensors");
    } else {
      judged.level.reason += ", though " + otherwise(judged.level, *other);
    }
  }
  return judged;
}

}  // namespace

const base::OptionTable<LevelOptions>& LevelOptions::table() {
  static const auto table = base::OptionTable<LevelOptions>().number(
      "base_sigma_deg", &LevelOptions::base_sigma, base::Range{0.01, 45},
      "Standard deviation of the tilt of floors and of the chassis of robots on wheels.");
  return table;
}

JudgedLevel estimateLevel(const mapper::State& state, const LevelEvidence& evidence, mapper::Motion motion,
                          const LevelOptions& options) {
  Level imu = byGravity(state.map, evidence);
  const auto* saved = state.map.layers.find<Level>();
  if (!imu.isKnown() && saved && saved->source == Level::Source::imu) imu = *saved;
  double margin = 0;
  const Level planes = bySurfaces(state, margin);
  const Level base = byBase(state.map, evidence, motion, options.base_sigma);
  if (base.isKnown() && motion == mapper::Motion::planar)
    return judgedWithBase(base, {&imu, &planes}, options.base_sigma);
  JudgedLevel judged;
  if (imu.isKnown()) {
    judged.level = imu;
    if (planes.isKnown()) {
      if (!contradict(imu, planes)) {
        judged.level = fused(imu, planes);
      } else {
        judged.level.reason += ", though " + otherwise(imu, planes);
        judged.warnings.push_back("gravity and surfaces do not agree on which way is up: " + otherwise(imu, planes) +
                                  " (" + planes.reason +
                                  "); gravity is used. Is the inertial sensor's pose on the base right?");
      }
    }
  } else if (planes.isKnown()) {
    judged.level = planes;
    if (base.isKnown() && contradict(planes, base))
      judged.warnings.push_back("the base is not level: by planes it is tilted by " +
                                degrees(angleBetween(planes.up, base.up)) + " on average (" + planes.reason + ")");
  } else if (base.isKnown()) {
    judged.level = base;
  } else {
    judged.level.reason =
        (imu.reason.empty() ? "no inertial sensor" : imu.reason) + "; " + planes.reason + "; " + base.reason;
  }
  return judged;
}

}  // namespace omnimapper::plugins
