#include "CameraFit.h"

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Conversions.h>

#include <algorithm>
#include <cmath>

#include "Quantile.h"
#include "WallFit.h"

namespace omnimapper::check {

namespace {

using Eigen::Vector3d;

constexpr double kDegree = base::option_text::kRadiansPerDegree;
constexpr double kLeastArea = 0.15;  // [m2] of a plane

// What the images may be otherwise than declared.
struct Hypothesis {
  CameraFacts::Images images = CameraFacts::Images::as_declared;
  double scale = 1;  // of the depths
  double focal = 1;  // true focal length divided by the declared one
  bool changesDepths() const { return scale != 1 || images == CameraFacts::Images::ranges; }
};

// The floor in the frame of the sensor.
struct Floor {
  Vector3d up;
  Measured distance;
  double up_sigma;  // [rad] about each axis
  std::size_t images;
};

// The plane as the camera sees it with a focal length that is `focal` times as long: all points come nearer to the
// axis.
void stretch(geometry::Plane3& plane, double focal) {
  const Vector3d normal(plane.normal.x(), plane.normal.y() * focal, plane.normal.z() * focal);
  plane = {normal.normalized(), plane.distance / normal.norm()};
}

std::vector<View> viewsOf(const std::vector<SampledImage>& images, const Hypothesis& hypothesis) {
  std::vector<View> views;
  for (const auto& [image, found, noise] : images) {
    auto planes = found;
    if (hypothesis.changesDepths()) {
      auto changed = std::make_shared<mrpt::obs::CObservation3DRangeScan>(*image);
      changed->rangeUnits = static_cast<float>(changed->rangeUnits * hypothesis.scale);
      if (hypothesis.images == CameraFacts::Images::ranges) changed->range_is_depth = false;
      planes = planesOf(*changed, noise);
    }
    View view{image->timestamp, {}};
    if (planes) {
      for (const auto& plane : planes->planes) {
        const double area = geometry::area(plane.outline);
        if (area < kLeastArea * std::min(1.0, hypothesis.scale * hypothesis.scale)) continue;
        const double variance = 0.5 * plane.covariance.topLeftCorner<2, 2>().trace();
        view.planes.push_back({plane.plane_in_sensor, std::sqrt(std::max(0.0, variance))});
        if (hypothesis.images == CameraFacts::Images::mirrored) view.planes.back().plane.normal.y() *= -1;
        stretch(view.planes.back().plane, hypothesis.focal);
      }
    }
    views.push_back(std::move(view));
  }
  return views;
}

// The mean of planes that are seen again and again. What one image has wrong, such as the depth noise of the place
// where the floor is seen, another one has, too, so that the mean is not known better than by some share of the
// scatter.
Floor meanOf(const std::vector<geometry::Plane3>& planes, const Vector3d& up) {
  constexpr double kIndependent = 4;                                   // images that share their errors
  constexpr double kLeastAngle = 0.05 * kDegree, kLeastShare = 0.002;  // [rad] [of the distance] of a depth camera
  const double n = static_cast<double>(planes.size());
  Floor floor{up, {}, 0, planes.size()};
  for (const auto& plane : planes) floor.distance.value += plane.distance / n;
  double angles = 0, distances = 0;
  for (const auto& plane : planes) {
    angles += (plane.normal - up).squaredNorm() / 2;
    distances += (plane.distance - floor.distance.value) * (plane.distance - floor.distance.value);
  }
  const double independent = std::max(1.0, n / kIndependent);
  floor.up_sigma = std::hypot(kLeastAngle, std::sqrt(angles / n / independent));
  floor.distance.sigma = std::hypot(kLeastShare * floor.distance.value, std::sqrt(distances / n / independent));
  return floor;
}

// The plane that most images show at one place. Walls move in the frame of the sensor while the robot drives.
std::optional<Floor> floorOf(const std::vector<View>& views, const Eigen::Matrix3d& base_from_sensor) {
  constexpr double kSameDirection = 4 * kDegree, kSameDistance = 0.08;  // [rad] [of the distance]
  const auto same = [&](const geometry::Plane3& a, const geometry::Plane3& b) {
    return a.normal.dot(b.normal) > std::cos(kSameDirection) &&
           std::abs(a.distance - b.distance) < kSameDistance * a.distance;
  };
  std::size_t with_planes = 0;
  for (const auto& view : views) with_planes += !view.planes.empty();
  std::optional<Floor> best;
  double best_score = 0;
  for (const auto& view : views) {
    for (const auto& candidate : view.planes) {
      const auto& plane = candidate.plane;
      Vector3d up = Vector3d::Zero();
      std::vector<geometry::Plane3> seen;
      for (const auto& other : views) {
        const auto found = std::find_if(other.planes.begin(), other.planes.end(),
                                        [&](const CameraPlane& one) { return same(plane, one.plane); });
        if (found == other.planes.end()) continue;
        up += found->plane.normal;
        seen.push_back(found->plane);
      }
      // Of planes that are seen as often, the one that the declared pose calls level is the floor.
      const double score = static_cast<double>(seen.size()) + (base_from_sensor * plane.normal).z();
      if (score <= best_score) continue;
      best_score = score;
      best = meanOf(seen, up.normalized());
    }
  }
  const bool is_seen_often = best && best->images >= 4 && 3 * best->images >= with_planes;
  return is_seen_often ? best : std::nullopt;
}

// Rotation of the base that makes the floor level. A camera upside down is turned about its optical axis.
Eigen::Matrix3d levelling(const Floor& floor, const Eigen::Matrix3d& base_from_sensor) {
  const Vector3d up = base_from_sensor * floor.up;
  if (up.z() > -0.9) return Eigen::Quaterniond::FromTwoVectors(up, Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d turned(Eigen::AngleAxisd(M_PI, base_from_sensor * Vector3d::UnitX()));
  return Eigen::Quaterniond::FromTwoVectors(turned * up, Vector3d::UnitZ()).toRotationMatrix() * turned;
}

double medianDepth(const std::vector<SampledImage>& images) {
  constexpr int kStep = 7;
  std::vector<double> depths;
  for (const auto& [image, planes, noise] : images) {
    const auto& range = image->rangeImage;
    for (int row = 0; row < range.rows(); row += kStep) {
      for (int column = 0; column < range.cols(); column += kStep) {
        if (range(row, column) > 0 && range(row, column) < 65535)
          depths.push_back(range(row, column) * image->rangeUnits);
      }
    }
  }
  return depths.empty() ? 0 : quantile(depths, 0.5);
}

// One explanation of the images, with all that was measured under it.
CameraFacts explained(const std::vector<SampledImage>& images, const CameraWitness& witness,
                      const Hypothesis& hypothesis) {
  CameraFacts facts;
  facts.are = hypothesis.images;
  const auto views = viewsOf(images, hypothesis);
  for (const auto& view : views) facts.planes += view.planes.size();
  const auto declared = geometry::fromMrpt(images.front().image->sensorPose);
  const Eigen::Matrix3d rotation = declared.rotation.toRotationMatrix();
  Eigen::Matrix3d level = Eigen::Matrix3d::Identity();
  if (const auto floor = floorOf(views, rotation)) {
    level = levelling(*floor, rotation);
    facts.floor_images = floor->images;
    facts.height = floor->distance;
    facts.tilt_sigma = floor->up_sigma;
    facts.tilt = std::acos(std::clamp((rotation * floor->up).z(), -1.0, 1.0));
    facts.pose = geometry::toMrpt(geometry::Se3{Eigen::Quaterniond(level * rotation), declared.translation});
  }
  const WallFit fit(views, witness, level * rotation, declared.translation);
  facts.walls = fit.size();
  fit.measure(facts);
  if (facts.scale) facts.scale = Measured{facts.scale->value * hypothesis.scale, facts.scale->sigma * hypothesis.scale};
  // By the depths of the log.
  if (facts.height)
    facts.height = Measured{facts.height->value / hypothesis.scale, facts.height->sigma / hypothesis.scale};
  if (facts.focal) facts.focal = Measured{facts.focal->value * hypothesis.focal, facts.focal->sigma * hypothesis.focal};
  if (facts.yaw) {
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(facts.yaw->value, Vector3d::UnitZ()).toRotationMatrix();
    facts.pose = geometry::toMrpt(geometry::Se3{Eigen::Quaterniond(turned * level * rotation), declared.translation});
  }
  return facts;
}

// A camera that looks backwards, or has another focal length by half, is less likely than one that has one fault.
bool isOdd(const CameraFacts& facts) {
  constexpr double kBackwards = 100 * kDegree, kFocal = 1.6;
  return facts.yaw &&
         (std::abs(facts.yaw->value) > kBackwards || facts.focal->value > kFocal || facts.focal->value < 1 / kFocal);
}

bool explainsWell(const CameraFacts& facts) {
  return facts.matched >= kFewestWalls && 2 * facts.matched >= facts.walls && !isOdd(facts);
}

// Whether nothing is wrong with the camera, or little.
bool isAsDeclared(const CameraFacts& facts) {
  constexpr double kYaw = 2 * kDegree, kTilt = 2 * kDegree, kShare = 0.03;
  return facts.yaw && std::abs(facts.yaw->value) < kYaw && facts.tilt < kTilt &&
         std::abs(facts.scale->value - 1) < kShare && std::abs(facts.focal->value - 1) < kShare;
}

// How well images are explained: the walls that are found, and the share of the planes that lie on them.
double quality(const CameraFacts& facts) {
  constexpr double kUnlikely = 0.6;
  const double all = static_cast<double>(std::max(facts.walls, kFewestWalls)),
               matched = static_cast<double>(facts.matched);
  return matched * matched / all * (isOdd(facts) ? kUnlikely : 1);
}

}  // namespace

bool Measured::differs(double expected, double least) const {
  constexpr double kSigmas = 4;
  return std::abs(value - expected) > std::max(least, kSigmas * sigma);
}

CameraFacts fitCamera(const std::vector<SampledImage>& images, const CameraWitness& witness) {
  Hypothesis hypothesis;
  auto best = explained(images, witness, hypothesis);
  if (witness.sees_walls && !isAsDeclared(best)) {
    constexpr double kMuchBetter = 1.4, kAlmost = 0.9;
    const bool is_explained = explainsWell(best);
    const double first = quality(best);
    double most = 0;
    std::vector<Hypothesis> others{{CameraFacts::Images::mirrored, 1, 1}};
    if (images.front().image->range_is_depth) others.push_back({CameraFacts::Images::ranges, 1, 1});
    for (const double scale : {0.001, 0.01, 0.1, 0.2, 0.5, 2.0, 5.0, 10.0, 100.0, 1000.0}) {
      if (!is_explained) others.push_back({CameraFacts::Images::as_declared, scale, 1});
    }
    for (const auto& other : others) {
      auto facts = explained(images, witness, other);
      // Another kind of image with nothing else wrong is a better explanation than several wrong values.
      if (is_explained && !isAsDeclared(facts)) continue;
      const double needed = (isAsDeclared(facts) ? kAlmost : kMuchBetter) * first;
      if (facts.matched < kFewestWalls || quality(facts) <= std::max(needed, most)) continue;
      most = quality(facts);
      best = std::move(facts);
      hypothesis = other;
    }
  }
  // A wrong focal length also bends what else is measured.
  constexpr double kWrongFocal = 0.03;
  for (int round = 0; round < 2 && best.focal && best.focal->differs(hypothesis.focal, kWrongFocal); ++round) {
    hypothesis.focal = best.focal->value;
    auto again = explained(images, witness, hypothesis);
    if (!again.focal || 10 * again.matched < 9 * best.matched) break;
    best = std::move(again);
  }
  const auto& first = *images.front().image;
  best.camera = first.sensorLabel;
  best.images = images.size();
  best.noise = images.front().noise;
  best.columns = static_cast<unsigned>(first.rangeImage.cols());
  best.rows = static_cast<unsigned>(first.rangeImage.rows());
  best.fx = first.cameraParams.fx();
  best.fy = first.cameraParams.fy();
  best.median_depth = medianDepth(images);
  best.declared = first.sensorPose;
  return best;
}

}  // namespace omnimapper::check
