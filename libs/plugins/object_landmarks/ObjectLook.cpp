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

  DepthsAround(const camera::DepthImage& image, int x, int y, int reach, double depth, double tolerance) {
    for (int row = std::max(0, y - reach); row <= std::min(image.height() - 1, y + reach); ++row) {
      for (int column = std::max(0, x - reach); column <= std::min(image.width() - 1, x + reach); ++column) {
        ++all;
        const double there = image.at(static_cast<std::size_t>(row) * image.width() + column);
        if (!(there > 0) || !std::isfinite(there)) continue;
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
    const DepthsAround around(image, static_cast<int>(std::lround(point.x)), static_cast<int>(std::lround(point.y)),
                              kReach, depth, tolerance);
    const bool shows_absence = depthBehind(point, object, camera_in_map) > 2 * tolerance;
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

bool mayBeBeside(const ObjectGeometry& object, const LookingCamera& camera, double reach) {
  constexpr double kFinest = 0.02;  // [m]
  constexpr int kMostSteps = 6;     // to each side
  constexpr std::size_t kCompared = 100;
  const double step = std::max(kFinest, reach / kMostSteps);
  const int steps = static_cast<int>(std::ceil(reach / step));
  const auto front = FrontOfObject(object, camera).points();
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < std::min(front.size(), kCompared); ++i)
    points.push_back(front[i * front.size() / std::min(front.size(), kCompared)].in_optical);
  const camera::DepthImage& image = camera.image;
  const camera::Pinhole& pinhole = image.camera();
  const auto agrees = [&](const Eigen::Vector3d& point) {
    if (!(point.z() > camera.min_depth)) return false;
    const double x = pinhole.fx * point.x() / point.z() + pinhole.cx;
    const double y = pinhole.fy * point.y() / point.z() + pinhole.cy;
    if (!(x >= 0 && x < image.width() - 1 && y >= 0 && y < image.height() - 1)) return false;
    const double there = image.at(static_cast<std::size_t>(std::lround(y)) * image.width() + std::lround(x));
    return there > 0 && std::abs(there - point.z()) <= toleranceAt(point.z()) + 0.5 * step;
  };
  for (int x = -steps; x <= steps; ++x) {
    for (int y = -steps; y <= steps; ++y) {
      for (int z = -steps; z <= steps; ++z) {
        const Eigen::Vector3d shift = step * Eigen::Vector3d(x, y, z);
        if (shift.norm() > reach + step) continue;
        const auto agreeing =
            std::count_if(points.begin(), points.end(), [&](const auto& point) { return agrees(point + shift); });
        if (2 * static_cast<std::size_t>(agreeing) >= points.size()) return true;
      }
    }
  }
  return false;
}

}  // namespace omnimapper::plugins
