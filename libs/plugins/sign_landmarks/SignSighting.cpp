#include "SignSighting.h"

#include <mrpt/img/CImage.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/plugin/PoseFactors.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace omnimapper::plugins {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

graph::FactorRecord recordOf(const std::vector<base::VariableId>& variables,
                             std::shared_ptr<const graph::Factor> factor, const Eigen::VectorXd& sigmas,
                             const char* note) {
  graph::FactorRecord record{variables, std::move(factor), graph::SquareRootInformation::fromSigmas(sigmas)};
  record.tags.note = note;
  return record;
}

double areaOf(const obs::ObservedDoorSign& sign) {
  double doubled = 0;
  for (std::size_t i = 0; i < sign.corners_px.size(); ++i) {
    const Eigen::Vector2d a = sign.corners_px[i].cast<double>();
    const Eigen::Vector2d b = sign.corners_px[(i + 1) % sign.corners_px.size()].cast<double>();
    doubled += a.x() * b.y() - a.y() * b.x();
  }
  return std::isfinite(doubled) ? std::abs(doubled) / 2 : 0;
}

// So that maps and what waits stay small.
mrpt::img::CImage reduced(const mrpt::img::CImage& patch) {
  constexpr double kMostPixels = 120 * 80;
  if (patch.isEmpty()) return patch;
  const auto width = static_cast<double>(patch.getWidth()), height = static_cast<double>(patch.getHeight());
  const double scale = std::sqrt(kMostPixels / (width * height));
  if (scale >= 1) return patch;
  mrpt::img::CImage small;
  patch.scaleImage(small, std::max(1U, static_cast<unsigned>(width * scale)),
                   std::max(1U, static_cast<unsigned>(height * scale)), mrpt::img::IMG_INTERP_AREA);
  return small;
}

map::Photograph photographOf(const mrpt::img::CImage& patch) {
  map::Photograph photograph;
  photograph.width = static_cast<int>(patch.getWidth());
  photograph.height = static_cast<int>(patch.getHeight());
  const std::size_t channels = patch.isColor() ? 3 : 1;
  for (int y = 0; y < photograph.height; ++y) {
    const auto* pixel = patch.ptrLine<std::uint8_t>(static_cast<unsigned>(y));
    for (int x = 0; x < photograph.width; ++x, pixel += channels)  // blue first
      photograph.rgb.insert(photograph.rgb.end(), {pixel[channels - 1], pixel[channels / 2], pixel[0]});
  }
  return photograph;
}

}  // namespace

SignLook SignSighting::look(base::KeyFrameId frame) const {
  const bool has_patch = !patch.isEmpty();
  return {frame, seen.direction(), area_px,
          has_patch ? std::make_shared<const map::Photograph>(photographOf(patch)) : nullptr};
}

graph::FactorRecord SignSighting::directionRecord(base::VariableId pose, base::VariableId point,
                                                  std::optional<base::VariableId> offsets,
                                                  const SignLandmarksOptions& options) const {
  std::vector<base::VariableId> variables{pose, point};
  std::shared_ptr<const graph::Factor> factor;
  if (offsets) {
    variables.push_back(*offsets);
    factor = std::make_shared<PanTiltBearingFactor>(seen, tilt_axis);
  } else {
    factor = std::make_shared<SignBearingFactor>(seen);
  }
  auto record = recordOf(variables, std::move(factor), Eigen::Vector2d(sigma_left, sigma_down), "sign sighting");
  record.loss = graph::Loss::cauchy(options.loss_scale);
  return record;
}

std::optional<graph::FactorRecord> SignSighting::rangeRecord(base::VariableId pose, base::VariableId point) const {
  constexpr double kLossScale = 2;  // [sigma] a beam may end before the sign or behind it
  if (!range) return std::nullopt;
  auto record = recordOf({pose, point}, std::make_shared<SignRangeFactor>(seen.camera(), *range),
                         Eigen::VectorXd::Constant(1, range_sigma / *range), "range of a sign");
  record.loss = graph::Loss::cauchy(kLossScale);
  return record;
}

graph::FactorRecord SignSighting::legibilityRecord(base::VariableId pose, base::VariableId point) const {
  constexpr double kFactor = 2.2;  // two signs of three are read from 1.1 to 5.5 m
  return recordOf({pose, point}, std::make_shared<SignRangeFactor>(seen.camera(), kReadingDistance),
                  Eigen::VectorXd::Constant(1, std::log(kFactor)), "a sign is read from near");
}

std::vector<SignSighting> signSightings(const obs::CObservationDoorSigns& observation,
                                        const SignLandmarksOptions& options) {
  constexpr double kLeastLevel = 0.05;  // of the direction, over the floor
  // [rad] how far the middle of what an image shows of a plate is from the plate's, where the edge cuts it: measured on
  // signs_30 and signs_200 (doc/results/signs.md).
  constexpr double kSigmaOfCut = 0.025;
  constexpr double kLeastRelative = 1e-4, kMostRelative = 10;  // standard deviation over range; others tell nothing
  const geometry::Se3 base_from_camera = geometry::fromMrpt(observation.sensorPose);
  const Vector3d left = base_from_camera.rotation * -Vector3d::UnitX();
  const double length = left.head<2>().norm();
  const Vector3d tilt_axis = length > 0.5 ? Vector3d(left.x() / length, left.y() / length, 0) : Vector3d::UnitY();
  std::vector<SignSighting> sightings;
  for (const auto& sign : observation.signs) {
    SignText text = textOf(sign, options.min_confidence);
    const Vector3d direction = base_from_camera.rotation * sign.ray;
    const double level = direction.head<2>().norm();
    if (text.empty() || !direction.allFinite() || !(level > kLeastLevel)) continue;
    const double relative = sign.range ? sign.range_sigma / *sign.range : 0;
    const bool has_range = sign.range && *sign.range > 0 && std::isfinite(*sign.range) && relative > kLeastRelative &&
                           relative < kMostRelative;
    const double pixel_sigma = sign.is_cut ? std::hypot(options.pixel_sigma, kSigmaOfCut) : options.pixel_sigma;
    // A pan turns what is near the vertical less.
    sightings.push_back({std::move(text), SeenDirection(base_from_camera.translation, direction.normalized()),
                         tilt_axis, std::hypot(pixel_sigma, level * options.pan_sigma),
                         std::hypot(pixel_sigma, options.tilt_sigma), has_range ? sign.range : std::nullopt,
                         sign.range_sigma, areaOf(sign), reduced(sign.patch)});
  }
  return sightings;
}

namespace {

struct Ray {
  Vector3d origin, direction;   // in the map
  double sigma;                 // [rad] of its own
  double sigma_with_offsets;    // [rad] with what all rays have in common
  std::optional<double> range;  // [m] where it was measured
  double range_sigma;           // [m]
};

std::vector<Ray> raysOf(const std::vector<SignView>& views, const graph::Graph& graph, const KnownOffsets& offsets) {
  std::vector<Ray> rays;
  for (const auto& [frame, pose, label, sighting, travelled] : views) {
    const geometry::Se3 map_from_base = geometry::fromMrpt(mapper::poseOf(graph, pose));
    const Vector3d direction = turnedBy(offsets.pan_tilt, sighting.tilt_axis, sighting.seen.direction());
    const double sigma = std::max(sighting.sigma_left, sighting.sigma_down);
    rays.push_back({map_from_base * sighting.seen.camera(), map_from_base.rotation * direction, sigma,
                    std::hypot(sigma, offsets.sigma), sighting.range, sighting.range_sigma});
  }
  return rays;
}

// By how much a ray misses a point, in standard deviations of its direction, or of its range where that misses by more;
// infinite behind its camera.
double missOf(const Ray& ray, const Vector3d& point) {
  constexpr double kNearest = 0.2;  // [m]
  const double ahead = ray.direction.dot(point - ray.origin);
  if (!(ahead > kNearest)) return std::numeric_limits<double>::infinity();
  const double aside = (point - ray.origin).cross(ray.direction).norm() / (ray.sigma_with_offsets * ahead);
  return ray.range ? std::max(aside, std::abs(ahead - *ray.range) / ray.range_sigma) : aside;
}

// [m] along the axis that is known worst.
double sigmaOf(const Matrix3d& information) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(information, Eigen::EigenvaluesOnly);
  return 1 / std::sqrt(std::max(axes.eigenvalues()[0], 1e-12));
}

// By least squares of the distances from the rays, weighted by what an angle is at the point of the round before, and
// of what their ranges miss by.
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
  return Triangulation{point, sigmaOf(information), {}};
}

// The least sum of squared angles and errors of range, from a point that is near. Distances favour what is near the
// cameras, where rays are nearly parallel.
std::optional<Triangulation> refined(Vector3d point, const std::vector<const Ray*>& rays) {
  constexpr int kRounds = 10;
  Matrix3d information;
  for (int round = 0; round < kRounds; ++round) {
    information.setZero();
    Vector3d gradient = Vector3d::Zero();
    for (const Ray* ray : rays) {
      const Vector3d seen = point - ray->origin;
      const double ahead = ray->direction.dot(seen);
      if (!(ahead > 0)) return std::nullopt;
      const Vector3d aside = seen - ahead * ray->direction;
      const Matrix3d by_point = (Matrix3d::Identity() - ray->direction * ray->direction.transpose() -
                                 aside * ray->direction.transpose() / ahead) /
                                (ray->sigma * ahead);
      information += by_point.transpose() * by_point;
      gradient += by_point.transpose() * aside / (ray->sigma * ahead);
      if (ray->range) {
        const Vector3d towards = seen.normalized();
        information += towards * towards.transpose() / std::pow(ray->range_sigma, 2);
        gradient += towards * (seen.norm() - *ray->range) / std::pow(ray->range_sigma, 2);
      }
    }
    const Eigen::LDLT<Matrix3d> solver(information);
    if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 1e-9 * information.trace()))
      return std::nullopt;
    point -= solver.solve(gradient);
  }
  if (!point.allFinite()) return std::nullopt;
  return Triangulation{point, sigmaOf(information), {}};
}

}  // namespace

std::optional<Triangulation> triangulate(const std::vector<SignView>& views, const graph::Graph& graph,
                                         const KnownOffsets& offsets, double max_sigma, std::size_t min_views) {
  constexpr double kMostSigmas = 3;
  const auto rays = raysOf(views, graph, offsets);
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
  if (found) found = refined(found->point, of_best);
  if (!found || !(found->sigma <= max_sigma)) return std::nullopt;
  for (const auto i : best)
    if (missOf(rays[i], found->point) <= kMostSigmas) found->views.push_back(i);
  return found->views.size() < min_views ? std::nullopt : found;
}

}  // namespace omnimapper::plugins
