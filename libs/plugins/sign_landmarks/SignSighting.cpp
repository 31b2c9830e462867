#include "SignSighting.h"

#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "SignBearingFactor.h"

namespace omnimapper::plugins {

using Eigen::Matrix3d;
using Eigen::Vector3d;

graph::FactorRecord SignSighting::record(base::VariableId pose, base::VariableId point,
                                         const SignLandmarksOptions& options) const {
  graph::FactorRecord record{{pose, point},
                             std::make_shared<SignBearingFactor>(camera, direction),
                             graph::SquareRootInformation::fromSigmas(Eigen::Vector2d(sigma_left, sigma_down))};
  record.loss = graph::Loss::huber(options.loss_scale);
  record.tags.note = "sign sighting";
  return record;
}

std::vector<SignSighting> signSightings(const obs::CObservationDoorSigns& observation,
                                        const SignLandmarksOptions& options) {
  constexpr double kLeastLevel = 0.05;  // of the direction, over the floor
  const geometry::Se3 base_from_camera = geometry::fromMrpt(observation.sensorPose);
  std::vector<SignSighting> sightings;
  for (const auto& sign : observation.signs) {
    SignText text = textOf(sign, options.min_confidence);
    const Vector3d direction = base_from_camera.rotation * sign.ray;
    const double level = direction.head<2>().norm();
    if (text.empty() || !direction.allFinite() || !(level > kLeastLevel)) continue;
    // A pan turns what is near the vertical less.
    sightings.push_back({std::move(text), base_from_camera.translation, direction.normalized(),
                         std::hypot(options.pixel_sigma, level * options.pan_sigma),
                         std::hypot(options.pixel_sigma, options.tilt_sigma)});
  }
  return sightings;
}

namespace {

struct Ray {
  Vector3d origin, direction;  // in the map
  double sigma;                // [rad]
};

std::vector<Ray> raysOf(const std::vector<SignView>& views, const graph::Graph& graph) {
  std::vector<Ray> rays;
  for (const auto& [pose, sighting, travelled] : views) {
    const geometry::Se3 map_from_base = geometry::fromMrpt(mapper::poseOf(graph, pose));
    rays.push_back({map_from_base * sighting.camera, map_from_base.rotation * sighting.direction,
                    std::max(sighting.sigma_left, sighting.sigma_down)});
  }
  return rays;
}

// How far a ray passes from a point, in standard deviations of its direction; infinite behind its camera.
double missOf(const Ray& ray, const Vector3d& point) {
  constexpr double kNearest = 0.2;  // [m]
  const double ahead = ray.direction.dot(point - ray.origin);
  if (!(ahead > kNearest)) return std::numeric_limits<double>::infinity();
  return (point - ray.origin).cross(ray.direction).norm() / (ray.sigma * ahead);
}

// By least squares of the distances, weighted by what an angle is at the point of the round before.
std::optional<Triangulation> meetingOf(const std::vector<const Ray*>& rays) {
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
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(information, Eigen::EigenvaluesOnly);
  return Triangulation{point, 1 / std::sqrt(axes.eigenvalues()[0]), {}};
}

}  // namespace

std::optional<Triangulation> triangulate(const std::vector<SignView>& views, const graph::Graph& graph,
                                         double max_sigma, std::size_t min_views) {
  constexpr double kMostSigmas = 3;
  const auto rays = raysOf(views, graph);
  if (rays.size() < min_views) return std::nullopt;
  // What the last view and one before it meet at, and who else passes there.
  std::vector<std::size_t> best;
  for (std::size_t i = 0; i + 1 < rays.size(); ++i) {
    const auto pair = meetingOf({&rays[i], &rays.back()});
    if (!pair) continue;
    std::vector<std::size_t> passing;
    for (std::size_t k = 0; k < rays.size(); ++k)
      if (missOf(rays[k], pair->point) <= kMostSigmas) passing.push_back(k);
    if (passing.size() > best.size() && passing.back() + 1 == rays.size()) best = std::move(passing);
  }
  if (best.size() < min_views) return std::nullopt;
  std::vector<const Ray*> of_best;
  for (const auto i : best) of_best.push_back(&rays[i]);
  auto found = meetingOf(of_best);
  if (!found || !(found->sigma <= max_sigma)) return std::nullopt;
  for (const auto i : best)
    if (missOf(rays[i], found->point) <= kMostSigmas) found->views.push_back(i);
  return found->views.size() < min_views ? std::nullopt : found;
}

}  // namespace omnimapper::plugins
