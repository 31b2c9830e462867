#include "Triangulation.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/SymmetricEigen.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace omnimapper::plugins {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kMostSigmas = 3;  // largest distance of a ray from the sign, in standard deviations

struct Ray {
  Vector3d origin, direction;               // in the map
  Eigen::Matrix<double, 3, 2> by_pan_tilt;  // derivative of the direction by the offsets of the unit
  double sigma;                             // [rad] of this ray alone
  double sigma_with_offsets;                // [rad] including the offsets that all rays share
  std::optional<double> range;              // [m] if it was measured
  double range_sigma;                       // [m]
};

std::vector<Ray> raysOf(const std::vector<SignView>& views, const graph::Graph& graph, const KnownOffsets& offsets) {
  std::vector<Ray> rays;
  for (const auto& [frame, stamp, pose, label, measurement, travelled] : views) {
    const geometry::Se3 map_from_base = geometry::fromMrpt(mapper::poseOf(graph, pose));
    const Vector3d direction =
        map_from_base.rotation * turnedBy(offsets.pan_tilt, measurement.tilt_axis, measurement.seen.direction());
    const double sigma = std::max(measurement.sigma_left, measurement.sigma_down);
    Ray ray{map_from_base * measurement.seen.camera(),
            direction,
            {},
            sigma,
            std::hypot(sigma, offsets.sigma),
            measurement.range,
            measurement.range_sigma};
    ray.by_pan_tilt.col(0) = (map_from_base.rotation * Vector3d::UnitZ()).cross(direction);
    ray.by_pan_tilt.col(1) = (map_from_base.rotation * measurement.tilt_axis).cross(direction);
    rays.push_back(ray);
  }
  return rays;
}

// Distance of a ray from a point, in standard deviations of its direction or of its range, whichever is more; infinite
// for a point behind its camera.
double missOf(const Ray& ray, const Vector3d& point) {
  constexpr double kNearest = 0.2;  // [m]
  const double ahead = ray.direction.dot(point - ray.origin);
  if (!(ahead > kNearest)) return std::numeric_limits<double>::infinity();
  const double aside = (point - ray.origin).cross(ray.direction).norm() / (ray.sigma_with_offsets * ahead);
  return ray.range ? std::max(aside, std::abs(ahead - *ray.range) / ray.range_sigma) : aside;
}

// The point with the smallest sum of squared distances from the rays and errors of their ranges. A ray is weighted by
// its angular standard deviation, converted to a distance at the point of the previous round.
std::optional<Vector3d> meetingOf(const std::vector<const Ray*>& rays) {
  constexpr int kRounds = 5;
  std::vector<double> weights(rays.size(), 1);
  Vector3d point = Vector3d::Zero();
  Matrix3d information;
  for (int round = 0; round < kRounds; ++round) {
    information.setZero();
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Matrix3d across = Matrix3d::Identity() - rays[i]->direction * rays[i]->direction.transpose();
      information += weights[i] * across;
      sum += weights[i] * across * rays[i]->origin;
      if (const auto& range = rays[i]->range) {
        const Matrix3d along = rays[i]->direction * rays[i]->direction.transpose();
        const double weight = round == 0 ? 1 : 1 / std::pow(rays[i]->range_sigma, 2);
        information += weight * along;
        sum += weight * along * (rays[i]->origin + *range * rays[i]->direction);
      }
    }
    const Eigen::LDLT<Matrix3d> solver(information);
    if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 1e-9 * information.trace()))
      return std::nullopt;
    point = solver.solve(sum);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double ahead = rays[i]->direction.dot(point - rays[i]->origin);
      if (!(ahead > 0)) return std::nullopt;
      weights[i] = 1 / std::pow(rays[i]->sigma * ahead, 2);
    }
  }
  return point;
}

// A point, with the correction of the known offsets of the pan-tilt unit [rad].
struct Meeting {
  Vector3d point;
  Eigen::Vector2d pan_tilt = Eigen::Vector2d::Zero();
  double sigma = 0;  // [m] of the point along the axis that is known worst
};

// Distance of a ray from a meeting, in standard deviations of this ray alone: the error that all rays share is in the
// offsets.
double missOf(const Ray& ray, const Meeting& meeting) {
  const Vector3d seen = meeting.point - ray.origin;
  const double ahead = ray.direction.dot(seen);
  if (!(ahead > 0)) return std::numeric_limits<double>::infinity();
  const double aside = ((seen - ahead * ray.direction) / ahead - ray.by_pan_tilt * meeting.pan_tilt).norm() / ray.sigma;
  return ray.range ? std::max(aside, std::abs(seen.norm() - *ray.range) / ray.range_sigma) : aside;
}

// Minimizes the sum of squared angles and range errors, starting from a point near the minimum. The distances that
// meetingOf() minimizes favour points near the cameras, where the rays are nearly parallel.
std::optional<Meeting> refined(const Vector3d& start, const std::vector<const Ray*>& rays, double offset_sigma) {
  constexpr int kRounds = 10;
  using Vector5 = Eigen::Matrix<double, 5, 1>;
  using Matrix5 = Eigen::Matrix<double, 5, 5>;
  Meeting meeting{start};
  Matrix5 information;
  for (int round = 0; round < kRounds; ++round) {
    information.setZero();
    Vector5 gradient = Vector5::Zero();
    information.diagonal().tail<2>().setConstant(1 / std::pow(std::max(offset_sigma, 1e-6), 2));
    gradient.tail<2>() = information(4, 4) * meeting.pan_tilt;
    for (const Ray* ray : rays) {
      const Vector3d seen = meeting.point - ray->origin;
      const double ahead = ray->direction.dot(seen);
      if (!(ahead > 0)) return std::nullopt;
      const Vector3d aside = seen - ahead * ray->direction;
      Eigen::Matrix<double, 3, 5> jacobian;
      jacobian << (Matrix3d::Identity() - ray->direction * ray->direction.transpose() -
                   aside * ray->direction.transpose() / ahead) /
                      (ray->sigma * ahead),
          -ray->by_pan_tilt / ray->sigma;
      information += jacobian.transpose() * jacobian;
      gradient += jacobian.transpose() * (aside / ahead - ray->by_pan_tilt * meeting.pan_tilt) / ray->sigma;
      if (ray->range) {
        const Vector3d towards = seen.normalized();
        information.topLeftCorner<3, 3>() += towards * towards.transpose() / std::pow(ray->range_sigma, 2);
        gradient.head<3>() += towards * (seen.norm() - *ray->range) / std::pow(ray->range_sigma, 2);
      }
    }
    const Eigen::LDLT<Matrix5> solver(information);
    const Matrix3d of_point = information.topLeftCorner<3, 3>();
    if (solver.info() != Eigen::Success || !(of_point.ldlt().vectorD().minCoeff() > 1e-9 * of_point.trace()))
      return std::nullopt;
    const Vector5 step = solver.solve(gradient);
    meeting.point -= step.head<3>();
    meeting.pan_tilt -= step.tail<2>();
  }
  if (!meeting.point.allFinite() || !meeting.pan_tilt.allFinite()) return std::nullopt;
  meeting.sigma = std::sqrt(geometry::eigenvaluesOf<3>(information.inverse().topLeftCorner<3, 3>())[2]);
  return meeting;
}

std::vector<std::size_t> passingNear(const Vector3d& point, const std::vector<Ray>& rays) {
  std::vector<std::size_t> passing;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (missOf(rays[i], point) <= kMostSigmas) passing.push_back(i);
  return passing;
}

// Views that meet, including the last one.
struct Agreed {
  Meeting meeting;
  std::vector<std::size_t> views;
  double chi2 = 0;

  bool isBetterThan(const Agreed& other) const {
    return views.size() != other.views.size() ? views.size() > other.views.size() : chi2 < other.chi2;
  }
};

// Leaves out the view that fits worst, one after the other, until the rest agree: the same words may be on several
// doors, and the rays to two of them pass near each other somewhere.
std::optional<Agreed> agreedOf(std::vector<std::size_t> views, const std::vector<Ray>& rays, double offset_sigma,
                               std::size_t min_views) {
  while (views.size() >= min_views && views.back() + 1 == rays.size()) {
    std::vector<const Ray*> chosen;
    for (const auto i : views) chosen.push_back(&rays[i]);
    const auto near = meetingOf(chosen);
    const auto meeting = near ? refined(*near, chosen, offset_sigma) : std::nullopt;
    if (!meeting) return std::nullopt;
    Agreed agreed{*meeting, views};
    std::size_t worst = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const double miss = missOf(rays[views[i]], *meeting);
      agreed.chi2 += miss * miss;
      if (miss > missOf(rays[views[worst]], *meeting)) worst = i;
    }
    if (missOf(rays[views[worst]], *meeting) <= kMostSigmas) return agreed;
    views.erase(views.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  return std::nullopt;
}

}  // namespace

std::optional<Triangulation> triangulate(const std::vector<SignView>& views, const graph::Graph& graph,
                                         const KnownOffsets& offsets, double max_sigma, std::size_t min_views) {
  const auto rays = raysOf(views, graph, offsets);
  if (rays.size() < min_views) return std::nullopt;
  std::optional<Agreed> best;
  std::set<std::vector<std::size_t>> tried;
  constexpr std::size_t kMostPairs = 15;
  const std::size_t first = rays.size() > kMostPairs ? rays.size() - 1 - kMostPairs : 0;
  for (std::size_t i = first; i + 1 < rays.size(); ++i) {
    const auto pair = meetingOf({&rays[i], &rays.back()});
    if (!pair) continue;
    auto passing = passingNear(*pair, rays);
    if (best && passing.size() < best->views.size()) continue;
    if (!tried.insert(passing).second) continue;
    auto agreed = agreedOf(std::move(passing), rays, offsets.sigma, min_views);
    if (agreed && agreed->meeting.sigma <= max_sigma && (!best || agreed->isBetterThan(*best)))
      best = std::move(agreed);
  }
  if (!best) return std::nullopt;
  return Triangulation{best->meeting.point, best->meeting.sigma, best->views};
}

}  // namespace omnimapper::plugins
