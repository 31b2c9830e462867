#include "LevelStatistics.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/geometry/SymmetricEigen.h>
#include <omnimapper/obs/GivenPose.h>
#include <omnimapper/surfaces/levelOfSurfaces.h>

#include <algorithm>
#include <cmath>

#include "Format.h"

namespace omnimapper::check {

namespace {

constexpr std::size_t kMostLabels = 10;

void setLevel(LevelFacts& facts, const std::optional<Eigen::Vector3d>& up, const Eigen::Matrix3d& covariance) {
  if (!up) return;
  facts.is_known = true;
  facts.up = *up;
  facts.sigma = std::sqrt(std::max(0.0, geometry::eigenvaluesOf<3>(covariance).maxCoeff()));
}

}  // namespace

double LevelFacts::tilt() const {
  return std::atan2(std::hypot(up.x(), up.y()), up.z());
}

void LevelStatistics::add(const mrpt::obs::CObservation& observation) {
  const std::string& label = observation.sensorLabel;
  if (!base::isValid(observation.timestamp)) return;
  if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation)) {
    if (imus_.count(label) > 0 || imus_.size() < kMostLabels) imus_[label].add(*imu);
  } else if (const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation)) {
    const auto reference_from_base = obs::referenceFromBase(*pose);
    if (reference_from_base && (poses_.count(label) > 0 || poses_.size() < kMostLabels))
      poses_[label].push_back({pose->timestamp, *reference_from_base});
  }
}

const LevelStatistics::Pose* LevelStatistics::poseAt(const std::vector<Pose>& poses, base::Stamp stamp) const {
  constexpr double kNear = 0.05;  // [s]
  auto best = std::lower_bound(poses.begin(), poses.end(), stamp,
                               [](const Pose& pose, base::Stamp when) { return pose.stamp < when; });
  if (best == poses.end() && best != poses.begin()) --best;
  if (best == poses.end()) return nullptr;
  if (best != poses.begin() &&
      base::secondsBetween(std::prev(best)->stamp, stamp) < base::secondsBetween(stamp, best->stamp))
    --best;
  return std::abs(base::secondsBetween(best->stamp, stamp)) < kNear ? &*best : nullptr;
}

LevelFacts LevelStatistics::byImu(const std::string& label, const motion::SteadySpans& spans,
                                  const std::vector<Pose>* poses) const {
  std::vector<motion::RotatedSpan> rotated;
  for (const auto& span : spans.all()) {
    const Pose* pose = poses ? poseAt(*poses, span.stamp) : nullptr;
    if (poses && !pose) continue;
    rotated.push_back(
        {pose ? geometry::fromMrpt(pose->reference_from_base).rotation : Eigen::Quaterniond::Identity(), span});
  }
  const auto gravity = motion::gravityOf(rotated);
  LevelFacts facts;
  facts.by = "the accelerometer " + check::quoted(label);
  facts.reason = gravity.reason;
  setLevel(facts, gravity.up, gravity.covariance);
  return facts;
}

LevelFacts LevelStatistics::byPlanes(const std::vector<SampledImage>& images, const std::vector<Pose>* poses) const {
  std::vector<surfaces::FlatArea> areas;
  std::vector<surfaces::Viewpoint> viewpoints;
  std::string label;
  for (const auto& image : images) {
    const Pose* pose = poses ? poseAt(*poses, image.planes->timestamp) : nullptr;
    if (poses && !pose) continue;
    const auto frame_from_sensor =
        geometry::fromMrpt((pose ? pose->reference_from_base : mrpt::poses::CPose3D()) + image.planes->sensorPose);
    viewpoints.push_back({frame_from_sensor.translation, frame_from_sensor.rotation * Eigen::Vector3d::UnitZ(),
                          frame_from_sensor.rotation * Eigen::Vector3d::UnitX()});
    label = image.image->sensorLabel;
    for (const auto& plane : image.planes->planes)
      areas.push_back({frame_from_sensor.rotation * plane.plane_in_sensor.normal, frame_from_sensor * plane.centroid,
                       geometry::area(plane.outline), 1});
  }
  const auto level = surfaces::levelOfSurfaces(areas, viewpoints);
  LevelFacts facts;
  facts.by_planes = true;
  facts.by = "the surfaces that " + std::to_string(viewpoints.size()) + " images of " + check::quoted(label) + " show";
  facts.reason = level.reason;
  setLevel(facts, level.up, level.covariance);
  return facts;
}

std::vector<LevelFacts> LevelStatistics::facts(bool has_wheels, const std::vector<SampledImage>& images) const {
  std::vector<LevelFacts> all;
  const auto collect = [&](const std::string& poses_label, const std::vector<Pose>* poses) {
    const auto add = [&](LevelFacts facts) {
      facts.poses = poses_label;
      facts.of_poses = poses != nullptr;
      all.push_back(std::move(facts));
    };
    for (const auto& [label, spans] : imus_) add(byImu(label, spans, poses));
    if (!images.empty()) add(byPlanes(images, poses));
  };
  for (auto [label, poses] : poses_) {
    std::stable_sort(poses.begin(), poses.end(), [](const Pose& a, const Pose& b) { return a.stamp < b.stamp; });
    collect(label, &poses);
  }
  if (has_wheels) collect("", nullptr);
  return all;
}

}  // namespace omnimapper::check
