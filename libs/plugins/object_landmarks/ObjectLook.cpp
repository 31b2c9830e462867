#include "ObjectLook.h"

#include <omnimapper/camera/DepthNoise.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace omnimapper::plugins {

namespace {

constexpr int kReach = 2;  // [px]
constexpr std::size_t kTried = 300;

// [m] Largest difference between a depth and that of a point of the model that errors explain.
double toleranceAt(double depth) {
  constexpr double kSigmas = 3, kSlack = 0.01;  // [-], [m] of the model itself
  const camera::DepthNoise noise;
  return kSigmas * depth * depth * std::sqrt(noise.pixelVariance() + noise.distortionVariance()) + kSlack;
}

struct Projected {
  Eigen::Vector3d in_optical, in_map;
  double x, y;  // pixel
};

// The points of the object that face the camera: the nearest in each cell of the image, and those just behind it.
class FrontOfObject {
 public:
  FrontOfObject(const ObjectGeometry& object, const LookingCamera& camera)
      : cell_(std::max(4.0, camera.image.width() / 80.0)) {
    const camera::Pinhole& pinhole = camera.image.camera();
    for (const auto& point : object.points) {
      const Eigen::Vector3d in_map = point.cast<double>(), p = camera.optical_from_map * in_map;
      if (!(p.z() > 0.05)) {
        ++behind_;
        continue;
      }
      const double x = pinhole.fx * p.x() / p.z() + pinhole.cx, y = pinhole.fy * p.y() / p.z() + pinhole.cy;
      if (std::abs(x) > 1e5 || std::abs(y) > 1e5) {
        ++behind_;
        continue;
      }
      all_.push_back({p, in_map, x, y});
      auto& nearest = nearest_.try_emplace(keyOf(cellOf(x), cellOf(y)), p.z()).first->second;
      nearest = std::min(nearest, p.z());
    }
  }
  bool isFront(const Projected& point) const {
    constexpr double kThick = 0.02;  // [m]
    double nearest = point.in_optical.z();
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const auto found = nearest_.find(keyOf(cellOf(point.x) + dx, cellOf(point.y) + dy));
        if (found != nearest_.end()) nearest = std::min(nearest, found->second);
      }
    }
    return point.in_optical.z() <= nearest + kThick;
  }
  std::vector<Projected> points() const {
    std::vector<Projected> front;
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(front), [&](const auto& p) { return isFront(p); });
    return front;
  }
  int behind() const { return behind_; }

 private:
  int cellOf(double pixel) const { return static_cast<int>(std::floor(pixel / cell_)); }
  static std::int64_t keyOf(int x, int y) { return static_cast<std::int64_t>(x) * (1 << 20) + y; }

  double cell_;  // [px]
  std::vector<Projected> all_;
  std::unordered_map<std::int64_t, double> nearest_;  // depth by cell
  int behind_ = 0;                                    // points that are not before the camera
};

// The depths around a pixel.
struct DepthsAround {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  int measured = 0, all = 0;
  bool agrees = false;  // one of them is that of the point

  DepthsAround(const LookingCamera& camera, int x, int y, int reach, double depth, double tolerance) {
    const camera::DepthImage& image = camera.image;
    constexpr double kNearest = 0.1;  // [m] no camera measures less
    for (int row = std::max(0, y - reach); row <= std::min(image.height() - 1, y + reach); ++row) {
      for (int column = std::max(0, x - reach); column <= std::min(image.width() - 1, x + reach); ++column) {
        ++all;
        const double there = image.at(static_cast<std::size_t>(row) * image.width() + column);
        if (!(there > kNearest && there < camera.farthest_depth)) continue;
        ++measured;
        least = std::min(least, there);
        most = std::max(most, there);
        agrees = agrees || std::abs(there - depth) <= tolerance;
      }
    }
  }
};

// By how much the depth at a point would grow without the object, as far as the surface on which it stands tells.
double depthBehind(const Projected& point, const ObjectGeometry& object, const Eigen::Vector3d& camera_in_map) {
  constexpr double kFree = std::numeric_limits<double>::infinity();
  if (!object.foot) return kFree;
  const double descent = object.up.dot(point.in_map - camera_in_map);
  if (descent >= 0) return kFree;  // the ray does not meet the surface
  const double share = object.up.dot(*object.foot - camera_in_map) / descent;
  return std::max(0.0, (share - 1) * point.in_optical.z());
}

// Whether the image would show by its depth that the point is not there.
bool showsAbsence(const Projected& point, const ObjectGeometry& object, const Eigen::Vector3d& camera_in_map) {
  return depthBehind(point, object, camera_in_map) > 2 * toleranceAt(point.in_optical.z());
}

// Places in an ellipsoid, whose half axes are the columns of `reach` [m]: along each axis at most kMostSteps to each
// side, and none but the middle if it is shorter than half of the finest step.
struct Shifts {
  double step = 0;  // [m] between neighbours
  std::vector<Eigen::Vector3d> all;
};

Shifts shiftsWithin(const Eigen::Matrix3d& reach) {
  constexpr double kFinest = 0.02, kMostSteps = 6;  // [m], [-]
  const Eigen::Vector3d lengths = reach.colwise().norm();
  Shifts shifts;
  shifts.step = std::max(kFinest, lengths.maxCoeff() / kMostSteps);
  const Eigen::Array3i steps = (lengths.array() / shifts.step + 0.5).floor().cast<int>();
  for (int x = -steps[0]; x <= steps[0]; ++x) {
    for (int y = -steps[1]; y <= steps[1]; ++y) {
      for (int z = -steps[2]; z <= steps[2]; ++z) {
        const Eigen::Array3d share = Eigen::Array3d(x, y, z) / steps.cast<double>().max(1);
        if (share.matrix().norm() <= 1) shifts.all.emplace_back(reach * share.matrix());
      }
    }
  }
  return shifts;
}

}  // namespace

Sight LookCounts::sight() const {
  constexpr int kFewest = 15;
  const int decided = seen + hidden + through, in_view = decided + unmeasured + undecided;
  if (in_view < outside || decided < kFewest || 4 * decided < in_view) return Sight::unknown;
  if (10 * through >= 7 * (decided + unmeasured) && 20 * seen <= 3 * decided) return Sight::absent;
  if (2 * hidden >= decided) return Sight::hidden;
  return seen >= through && 4 * seen >= decided ? Sight::seen : Sight::unknown;
}

bool isInView(const ObjectGeometry& object, const LookingCamera& camera) {
  const Eigen::Vector3d p = camera.optical_from_map * object.box.middle;
  if (object.points.empty() || !(p.z() > camera.min_depth && p.z() < camera.max_depth)) return false;
  const camera::Pinhole& pinhole = camera.image.camera();
  const double x = pinhole.fx * p.x() / p.z() + pinhole.cx, y = pinhole.fy * p.y() / p.z() + pinhole.cy;
  return x >= 0 && x < camera.image.width() && y >= 0 && y < camera.image.height();
}

LookCounts lookFor(const ObjectGeometry& object, const LookingCamera& camera) {
  const FrontOfObject front(object, camera);
  const auto points = front.points();
  const Eigen::Vector3d camera_in_map = geometry::inverse(camera.optical_from_map).translation;
  const camera::DepthImage& image = camera.image;
  LookCounts counts;
  counts.outside = front.behind();
  const std::size_t tried = std::min(points.size(), kTried);
  for (std::size_t i = 0; i < tried; ++i) {
    const Projected& point = points[i * points.size() / tried];
    const double depth = point.in_optical.z(), tolerance = toleranceAt(depth);
    const bool is_inside =
        point.x >= kReach && point.x < image.width() - kReach && point.y >= kReach && point.y < image.height() - kReach;
    if (!is_inside || depth < camera.min_depth || depth > camera.max_depth) {
      ++counts.outside;
      continue;
    }
    const DepthsAround around(camera, static_cast<int>(std::lround(point.x)), static_cast<int>(std::lround(point.y)),
                              kReach, depth, tolerance);
    const bool shows_absence = showsAbsence(point, object, camera_in_map);
    if (2 * around.measured < around.all) {
      ++counts.unmeasured;
    } else if (around.agrees) {
      ++(shows_absence ? counts.seen : counts.undecided);
    } else if (around.least > depth + tolerance) {
      ++(shows_absence ? counts.through : counts.undecided);
    } else {
      ++counts.hidden;
    }
  }
  return counts;
}

bool mayBeBeside(const ObjectGeometry& object, const LookingCamera& camera, const Eigen::Matrix3d& reach) {
  constexpr std::size_t kCompared = 100;
  const auto shifts = shiftsWithin(reach);
  auto front = FrontOfObject(object, camera).points();
  const geometry::Se3 map_from_optical = geometry::inverse(camera.optical_from_map);
  const Eigen::Vector3d camera_in_map = map_from_optical.translation;
  front.erase(std::remove_if(front.begin(), front.end(),
                             [&](const auto& point) { return !showsAbsence(point, object, camera_in_map); }),
              front.end());
  const std::size_t compared = std::min(front.size(), kCompared);
  const camera::DepthImage& image = camera.image;
  const camera::Pinhole& pinhole = image.camera();
  const auto agrees = [&](const Projected& point, const Eigen::Vector3d& shift) {
    const Eigen::Vector3d at = point.in_optical + shift;
    if (!(at.z() > camera.min_depth)) return false;
    const double x = pinhole.fx * at.x() / at.z() + pinhole.cx, y = pinhole.fy * at.y() / at.z() + pinhole.cy;
    if (!(x >= 0 && x < image.width() - 1 && y >= 0 && y < image.height() - 1)) return false;
    const double there = image.at(static_cast<std::size_t>(std::lround(y)) * image.width() + std::lround(x));
    if (!(there > 0 && std::abs(there - at.z()) <= toleranceAt(at.z()) + 0.5 * shifts.step)) return false;
    // What the image shows there may be the surface itself.
    return showsAbsence({at, point.in_map + map_from_optical.rotation * shift, x, y}, object, camera_in_map);
  };
  return std::any_of(shifts.all.begin(), shifts.all.end(), [&](const Eigen::Vector3d& shift) {
    std::size_t agreeing = 0;
    for (std::size_t i = 0; i < compared; ++i) agreeing += agrees(front[i * front.size() / compared], shift);
    return 2 * agreeing >= compared;
  });
}

}  // namespace omnimapper::plugins
