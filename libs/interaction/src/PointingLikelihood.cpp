#include "PointingLikelihood.h"

#include <Eigen/Geometry>
#include <cmath>

namespace omnimapper::interaction {

namespace {

using Eigen::Vector3d;

constexpr int kSteps = 20;       // of the grid of directions on each side of its middle
constexpr double kReach = 4.5;   // of the grid, in standard deviations
constexpr double kWidest = 1.4;  // [rad] at which tangents still are of use

}  // namespace

PointingLikelihood::PointingLikelihood(const PointingGesture& gesture, const PointingModel& model,
                                       const TargetOptions& options)
    : gesture_(gesture), model_(model), freedom_(options.freedom), side_(gesture.is_right_arm ? 1 : -1) {
  const auto add = [&](const std::optional<Vector3d>& from, RayErrors PointingRow::*errors) {
    if (!from) return;
    const Vector3d along = gesture.hand - *from;
    // A vertical ray has no azimuth.
    if (along.allFinite() && along.head<2>().norm() > 1e-6) rays_.push_back({along.normalized(), errors});
  };
  if (options.method != PointingMethod::head_hand) add(gesture.elbow, &PointingRow::elbow_hand);
  if (options.method != PointingMethod::elbow_hand) add(gesture.head, &PointingRow::head_hand);
}

// Generalized least squares of one number that is measured twice: with the covariance C of both errors, the weights are
// C^-1 1, and the variance is 1 / (1' C^-1 1).
PointingLikelihood::Residual PointingLikelihood::residualOf(const PointingRow& row,
                                                            const std::vector<PointingError>& errors,
                                                            bool is_theta) const {
  const auto angle = is_theta ? &RayErrors::theta : &RayErrors::psi;
  const auto offOf = [&](std::size_t i) {
    const double measured = is_theta ? side_ * errors[i].theta : errors[i].psi;
    return measured - (row.*rays_[i].errors.*angle).mean;
  };
  const double first_sigma = (row.*rays_[0].errors.*angle).sigma;
  if (rays_.size() == 1) return {offOf(0), first_sigma * first_sigma};
  const double second_sigma = (row.*rays_[1].errors.*angle).sigma;
  const double covariance = (is_theta ? model_.theta_correlation : model_.psi_correlation) * first_sigma * second_sigma;
  const double a = second_sigma * second_sigma - covariance, b = first_sigma * first_sigma - covariance;
  const double determinant = first_sigma * first_sigma * second_sigma * second_sigma - covariance * covariance;
  return {(a * offOf(0) + b * offOf(1)) / (a + b), determinant / (a + b)};
}

double PointingLikelihood::towards(const Vector3d& target) const {
  std::vector<PointingError> errors;
  for (const Ray& ray : rays_) {
    errors.push_back(pointingErrorOf(gesture_.hand, ray.ahead, target));
    if (!(std::abs(errors.back().theta) < kWidest && std::abs(errors.back().psi) < kWidest)) return 0;
  }
  const PointingRow row = errorsTowards(model_, directionOf(gesture_, target));
  const Residual theta = residualOf(row, errors, true), psi = residualOf(row, errors, false);
  const double square = theta.value * theta.value / theta.variance + psi.value * psi.value / psi.variance;
  const double density =
      std::pow(1 + square / freedom_, -(freedom_ + 2) / 2) / (2 * M_PI * std::sqrt(theta.variance * psi.variance));
  // The solid angle of a cell of both angles, at the error that was found.
  const double u = std::tan(theta.value), v = std::tan(psi.value);
  return density * std::pow(1 + u * u + v * v, 1.5) / ((1 + u * u) * (1 + v * v));
}

Vector3d PointingLikelihood::corrected() const {
  Vector3d sum = Vector3d::Zero();
  for (const Ray& ray : rays_) {
    Vector3d direction = ray.ahead;
    // The errors depend a little on the direction that they lead to.
    for (int i = 0; i < 3; ++i) {
      const RayErrors errors = errorsTowards(model_, directionOf(gesture_, gesture_.hand + direction)).*ray.errors;
      const Vector3d left = Vector3d(-ray.ahead.y(), ray.ahead.x(), 0).normalized(), down = left.cross(ray.ahead);
      direction =
          (ray.ahead + std::tan(side_ * errors.theta.mean) * left + std::tan(errors.psi.mean) * down).normalized();
    }
    const RayErrors errors = errorsTowards(model_, directionOf(gesture_, gesture_.hand + direction)).*ray.errors;
    sum += direction / (errors.theta.sigma * errors.psi.sigma);
  }
  return sum.normalized();
}

std::vector<PointingLikelihood::Direction> PointingLikelihood::directions() const {
  const Vector3d ahead = corrected();
  const Vector3d left = Vector3d(-ahead.y(), ahead.x(), 1e-12).normalized(), down = left.cross(ahead);
  const PointingRow row = errorsTowards(model_, directionOf(gesture_, gesture_.hand + ahead));
  double theta_sigma = 0, psi_sigma = 0;
  for (const Ray& ray : rays_) {
    theta_sigma = std::max(theta_sigma, (row.*ray.errors).theta.sigma);
    psi_sigma = std::max(psi_sigma, (row.*ray.errors).psi.sigma);
  }
  const double theta_step = std::min(kReach * theta_sigma, kWidest) / kSteps,
               psi_step = std::min(kReach * psi_sigma, kWidest) / kSteps;
  std::vector<Direction> directions;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      const double u = std::tan(i * theta_step), v = std::tan(j * psi_step);
      const double length = std::sqrt(1 + u * u + v * v);
      const double cell = (1 + u * u) * (1 + v * v) / (length * length * length) * theta_step * psi_step;
      directions.push_back({(ahead + u * left + v * down) / length, cell});
    }
  }
  return directions;
}

}  // namespace omnimapper::interaction
