#include "CameraFit.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/geometry/Conversions.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "Quantile.h"

namespace omnimapper::check {

namespace {

using Eigen::Vector3d;

constexpr double kDegree = base::option_text::kRadiansPerDegree;
constexpr double kLeastArea = 0.15;  // [m2] of a plane
constexpr double kUpright = 12 * kDegree;
constexpr std::size_t kFewestWalls = 6;

// What the images may be otherwise than declared.
struct Hypothesis {
  CameraFacts::Images images = CameraFacts::Images::as_declared;
  double scale = 1;  // of the depths
  double focal = 1;  // true focal length divided by the declared one
  bool changesDepths() const { return scale != 1 || images == CameraFacts::Images::ranges; }
};

struct CameraPlane {
  geometry::Plane3 plane;  // in the frame of the sensor
  double angle_sigma;      // [rad] of its normal
};

struct View {
  base::Stamp stamp;
  std::vector<CameraPlane> planes;
};

// The floor in the frame of the sensor.
struct Floor {
  Vector3d up;
  double distance;
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
  for (const auto& [image, found] : images) {
    auto planes = found;
    if (hypothesis.changesDepths()) {
      auto changed = std::make_shared<mrpt::obs::CObservation3DRangeScan>(*image);
      changed->rangeUnits = static_cast<float>(changed->rangeUnits * hypothesis.scale);
      if (hypothesis.images == CameraFacts::Images::ranges) changed->range_is_depth = !changed->range_is_depth;
      planes = planesOf(*changed);
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
    for (const auto& [plane, sigma] : view.planes) {
      Floor floor{Vector3d::Zero(), 0, 0};
      for (const auto& other : views) {
        const auto found = std::find_if(other.planes.begin(), other.planes.end(),
                                        [&](const CameraPlane& one) { return same(plane, one.plane); });
        if (found == other.planes.end()) continue;
        floor.up += found->plane.normal;
        floor.distance += found->plane.distance;
        ++floor.images;
      }
      // Of planes that are seen as often, the one that the declared pose calls level is the floor.
      const double score = static_cast<double>(floor.images) + (base_from_sensor * plane.normal).z();
      if (score <= best_score) continue;
      best_score = score;
      floor.distance /= static_cast<double>(floor.images);
      floor.up.normalize();
      best = floor;
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

// An upright plane of the camera, as a wall seen from the declared place of the sensor.
struct CameraWall {
  std::size_t view;
  double azimuth;   // [rad] in the base, once the floor is level
  double bearing;   // [rad] azimuth relative to the optical axis
  double distance;  // [m] from the sensor
  double sigma;     // [rad] of the azimuth
};

struct Match {
  const CameraWall* wall;
  BaseWall laser;
};

struct Vote {
  double yaw = 0, log_scale = 0;
  std::size_t planes = 0;  // that have a wall there
};

class WallFit {
 public:
  WallFit(const std::vector<View>& views, const CameraWitness& witness, const Eigen::Matrix3d& level_from_sensor,
          const Vector3d& position)
      : views_(views), witness_(witness), position_(position) {
    const Vector3d axis = level_from_sensor * Vector3d::UnitX();
    for (std::size_t i = 0; i < views.size(); ++i) {
      for (const auto& [plane, sigma] : views[i].planes) {
        const Vector3d normal = level_from_sensor * plane.normal;
        if (std::abs(normal.z()) > std::sin(kUpright)) continue;
        const double azimuth = std::atan2(-normal.y(), -normal.x());
        const double bearing = mrpt::math::wrapToPi(azimuth - std::atan2(axis.y(), axis.x()));
        walls_.push_back({i, azimuth, bearing, plane.distance, sigma});
      }
    }
  }

  std::size_t size() const { return walls_.size(); }

  // The yaw and the scale for which most planes vote if the images are late by `clock` [s].
  Vote vote(double clock) const {
    constexpr double kYawBin = 3 * kDegree, kScaleBin = 0.06;
    std::map<std::pair<int, int>, std::vector<std::size_t>> bins;  // walls of the camera
    const int turns = static_cast<int>(std::lround(2 * M_PI / kYawBin));
    const auto laser = lasersAt(clock);
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      for (const auto& other : laser[walls_[i].view]) {
        const auto [yaw, log_scale] = pairing(walls_[i], other);
        if (std::isnan(log_scale)) continue;
        const int a = static_cast<int>(std::floor(yaw / kYawBin)),
                  b = static_cast<int>(std::floor(log_scale / kScaleBin));
        // Each pair votes for four overlapping bins, so that no cluster is cut in two.
        for (int da = 0; da < 2; ++da) {
          for (int db = 0; db < 2; ++db) {
            auto& bin = bins[{((a + da) % turns + turns) % turns, b + db}];
            if (bin.empty() || bin.back() != i) bin.push_back(i);
          }
        }
      }
    }
    Vote best;
    double best_score = 0;
    for (const auto& [bin, planes] : bins) {
      const double yaw = mrpt::math::wrapToPi(bin.first * kYawBin), log_scale = bin.second * kScaleBin;
      // What is declared is more likely than what is far from it.
      const double score = static_cast<double>(planes.size()) - 0.5 * std::min(1.0, std::abs(yaw)) -
                           0.5 * std::min(1.0, std::abs(log_scale));
      if (score <= best_score) continue;
      best_score = score;
      best = {yaw, log_scale, planes.size()};
    }
    return best;
  }

  // Yaw, clock and focal length by least squares, and the scale, from the pairs near `start`.
  void refine(const Vote& start, double clock, CameraFacts& facts) const;

 private:
  std::vector<std::vector<BaseWall>> lasersAt(double clock) const {
    std::vector<std::vector<BaseWall>> all;
    for (const auto& view : views_) all.push_back(witness_.walls(view.stamp - base::durationFromSeconds(clock)));
    return all;
  }

  // [m] of the wall of the laser from the sensor.
  double distanceOf(const BaseWall& laser) const {
    return laser.distance - std::cos(laser.azimuth) * position_.x() - std::sin(laser.azimuth) * position_.y();
  }

  // The yaw and the logarithm of the scale with which the two are one wall; NaN if they cannot be one.
  std::pair<double, double> pairing(const CameraWall& wall, const BaseWall& laser) const {
    const double distance = distanceOf(laser);
    if (distance < 0.1 || wall.distance <= 0) return {0, std::nan("")};
    return {mrpt::math::wrapToPi(laser.azimuth - wall.azimuth), std::log(distance / wall.distance)};
  }

  std::vector<Match> matches(double yaw, double log_scale, double clock, double focal_slope) const;

  const std::vector<View>& views_;
  const CameraWitness& witness_;
  Vector3d position_;
  std::vector<CameraWall> walls_;
};

std::vector<Match> WallFit::matches(double yaw, double log_scale, double clock, double focal_slope) const {
  constexpr double kYaw = 6 * kDegree, kLogScale = 0.1;
  const auto laser = lasersAt(clock);
  std::vector<Match> matches;
  for (const auto& wall : walls_) {
    double best = 1;
    const BaseWall* found = nullptr;
    for (const auto& other : laser[wall.view]) {
      const auto [turn, scale] = pairing(wall, other);
      if (std::isnan(scale)) continue;
      const double off = mrpt::math::wrapToPi(turn - yaw - focal_slope * 0.5 * std::sin(2 * wall.bearing));
      const double cost = std::hypot(off / kYaw, (scale - log_scale) / kLogScale);
      if (cost >= best) continue;
      best = cost;
      found = &other;
    }
    if (found) matches.push_back({&wall, *found});
  }
  return matches;
}

// An equation `row` . x = value, and what it weighs.
struct Equation {
  Eigen::Vector3d row;
  double value, weight;
};

struct Solution {
  Eigen::Vector3d x;
  Eigen::Matrix3d covariance;
};

// Least squares from a first solution. Equations with large residuals are left out round by round, so that planes that
// were paired with another wall do not count. `prior` holds how far each unknown may be from its first value [standard
// deviations as of the unknown].
std::optional<Solution> solve(const std::vector<Equation>& equations, const Eigen::Vector3d& first,
                              const Eigen::Vector3d& prior, double least_sigma) {
  Solution solution{first, Eigen::Matrix3d::Identity()};
  for (int round = 0; round < 6; ++round) {
    std::vector<double> residuals;
    for (const auto& one : equations) residuals.push_back(std::abs(one.value - one.row.dot(solution.x)));
    if (residuals.size() < kFewestWalls) return std::nullopt;
    const double sigma = std::max(least_sigma, 1.4826 * quantile(residuals, 0.5)), limit = 3 * sigma;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      normal(i, i) = sigma * sigma / (prior[i] * prior[i]);
      right[i] = normal(i, i) * first[i];
    }
    std::size_t used = 0;
    for (std::size_t i = 0; i < equations.size(); ++i) {
      if (residuals[i] > limit) continue;
      const auto& one = equations[i];
      normal += one.weight * one.row * one.row.transpose();
      right += one.weight * one.row * one.value;
      ++used;
    }
    if (used < kFewestWalls) return std::nullopt;
    solution.x = normal.ldlt().solve(right);
    solution.covariance = sigma * sigma * normal.inverse();
  }
  return solution;
}

Measured measured(const Solution& solution, Eigen::Index i) {
  return {solution.x[i], std::sqrt(std::max(0.0, solution.covariance(i, i)))};
}

void WallFit::refine(const Vote& start, double clock, CameraFacts& facts) const {
  constexpr double kAngleSigma = 0.2 * kDegree, kDistanceSigma = 0.005;  // [rad] [m] of a plane and a line at best
  constexpr double kAnything = 10, kPlace = 0.03, kClock = 0.5, kFocal = 0.5;
  // Planes of one image share errors, such as those of the pose at which it was taken.
  constexpr double kShared = 1.5;
  double yaw = start.yaw, focal_slope = 0, scale = std::exp(start.log_scale);
  std::optional<Solution> angles, distances;
  for (int round = 0; round < 4; ++round) {
    const auto pairs = matches(yaw, std::log(scale), clock, focal_slope);
    std::vector<Equation> turns, places;
    for (const auto& [wall, laser] : pairs) {
      const auto rate = witness_.turning(views_[wall->view].stamp - base::durationFromSeconds(clock));
      const double weight = 1 / (1 + mrpt::square(wall->sigma / kDegree));
      turns.push_back({{1, rate.value_or(0), 0.5 * std::sin(2 * wall->bearing)},
                       mrpt::math::wrapToPi(laser.azimuth - wall->azimuth - yaw) + yaw,
                       weight});
      places.push_back({{wall->distance, std::cos(laser.azimuth), std::sin(laser.azimuth)}, distanceOf(laser), weight});
    }
    angles = solve(turns, {yaw, 0, focal_slope}, {kAnything, kClock, kFocal}, kAngleSigma);
    distances = solve(places, {scale, 0, 0}, {kAnything * scale, kPlace, kPlace}, kDistanceSigma);
    facts.matched = pairs.size();
    if (!angles || !distances) return;
    yaw = angles->x[0];
    focal_slope = angles->x[2];
    scale = distances->x[0];
    if (!(scale > 0)) return;
    // Walls of the laser at too late a time are turned back by as much as the base turned on until then.
    clock -= std::clamp(angles->x[1], -0.5, 0.5);
  }
  angles->covariance *= kShared * kShared;
  distances->covariance *= kShared * kShared;
  facts.yaw = measured(*angles, 0);
  facts.clock = Measured{clock, measured(*angles, 1).sigma};
  facts.scale = measured(*distances, 0);
  const auto slope = measured(*angles, 2);
  facts.focal = Measured{std::exp(slope.value), slope.sigma * std::exp(slope.value)};
}

double medianDepth(const std::vector<SampledImage>& images) {
  constexpr int kStep = 7;
  std::vector<double> depths;
  for (const auto& [image, planes] : images) {
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
  constexpr double kFarthestClock = 6, kStep = 0.1;  // [s]
  constexpr double kMuchBetter = 1.25;
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
    facts.tilt = std::acos(std::clamp((rotation * floor->up).z(), -1.0, 1.0));
    facts.pose = geometry::toMrpt(geometry::Se3{Eigen::Quaterniond(level * rotation), declared.translation});
  }
  const WallFit fit(views, witness, level * rotation, declared.translation);
  facts.walls = fit.size();
  if (facts.walls < kFewestWalls) return facts;
  double clock = 0;
  auto best = fit.vote(0);
  for (double other = -kFarthestClock; other <= kFarthestClock; other += kStep) {
    const auto vote = fit.vote(other);
    const bool is_first = clock == 0;
    if (static_cast<double>(vote.planes) <=
        (is_first ? kMuchBetter : 1.0) * static_cast<double>(best.planes) + (is_first ? 1 : 0))
      continue;
    best = vote;
    clock = other;
  }
  facts.matched = best.planes;
  if (best.planes < kFewestWalls) return facts;
  fit.refine(best, clock, facts);
  if (facts.scale) facts.scale = Measured{facts.scale->value * hypothesis.scale, facts.scale->sigma * hypothesis.scale};
  if (facts.height) *facts.height /= hypothesis.scale;  // by the depths of the log
  if (facts.focal) facts.focal = Measured{facts.focal->value * hypothesis.focal, facts.focal->sigma};
  if (facts.yaw) {
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(facts.yaw->value, Vector3d::UnitZ()).toRotationMatrix();
    facts.pose = geometry::toMrpt(geometry::Se3{Eigen::Quaterniond(turned * level * rotation), declared.translation});
  }
  return facts;
}

bool explainsWell(const CameraFacts& facts) {
  return facts.matched >= kFewestWalls && 2 * facts.matched >= facts.walls;
}

}  // namespace

bool Measured::differs(double expected, double least) const {
  constexpr double kSigmas = 4;
  return std::abs(value - expected) > std::max(least, kSigmas * sigma);
}

CameraFacts fitCamera(const std::vector<SampledImage>& images, const CameraWitness& witness) {
  Hypothesis hypothesis;
  auto best = explained(images, witness, hypothesis);
  if (!explainsWell(best)) {
    std::vector<Hypothesis> others{{CameraFacts::Images::mirrored, 1, 1}, {CameraFacts::Images::ranges, 1, 1}};
    for (const double scale : {0.001, 0.01, 0.1, 0.2, 0.5, 2.0, 5.0, 10.0, 100.0, 1000.0})
      others.push_back({CameraFacts::Images::as_declared, scale, 1});
    const auto quality = [](const CameraFacts& facts) {
      const double all = static_cast<double>(std::max<std::size_t>(facts.walls, kFewestWalls));
      return static_cast<double>(facts.matched) * static_cast<double>(facts.matched) / all;
    };
    constexpr double kMuchBetter = 1.4;
    double least = kMuchBetter * quality(best);
    for (const auto& other : others) {
      auto facts = explained(images, witness, other);
      if (facts.matched < kFewestWalls || quality(facts) <= least) continue;
      least = quality(facts);
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
  best.columns = static_cast<unsigned>(first.rangeImage.cols());
  best.rows = static_cast<unsigned>(first.rangeImage.rows());
  best.fx = first.cameraParams.fx();
  best.fy = first.cameraParams.fy();
  best.median_depth = medianDepth(images);
  best.declared = first.sensorPose;
  return best;
}

}  // namespace omnimapper::check
