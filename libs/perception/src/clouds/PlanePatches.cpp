#include "PlanePatches.h"

#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/SameLabel.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "../CommonError.h"
#include "FlatGrid.h"

namespace omnimapper::perception::clouds {

namespace {

// Largest squared distance, relative to that of inliers, of points that lie so near a surface that they belong to no
// other plane.
constexpr float kHalo = 2.5F;
// Largest sum of the variances of a plane's two rotations [rad^2]. Points on one line, such as those that one turn of a
// laser leaves of a wall, do not determine a plane.
constexpr double kMostTurn = 0.1;

using geometry::Plane3;

// Derivative of n.p + d by the plane's two rotations and its distance.
Eigen::Vector3d rowOf(const Eigen::Vector3d& point, const Eigen::Matrix<double, 3, 2>& basis) {
  return {basis.col(0).dot(point), basis.col(1).dot(point), 1};
}

// Information of a voxel's mean. The error of the mean is smaller than that of one point, except for the part that
// neighbouring points share.
double informationOf(const LoosePoints& points, int member, const Plane3& plane, const CloudPlaneOptions& options) {
  const auto i = static_cast<std::size_t>(member);
  const double of_point = static_cast<double>(points.tolerance(i, plane)) / (options.gate * options.gate);
  return static_cast<double>(points.of[i]) / (options.correlated_points * of_point);
}

// Standard deviation [m] of a point along its ray, from errors that all points share.
double sharedSigma(double range, const CloudPlaneOptions& options) {
  const double distortion =
      0.5 * options.distortion_at_1m * range * range;  // distortion_at_1m is two standard deviations
  return std::hypot(options.bias_sigma, distortion, options.scale_sigma * range);
}

// Covariance of the plane's two rotations and its distance, from the noise of the points and from errors along the rays
// that neighbouring rays share, so that they do not average out.
Eigen::Matrix3d covarianceOf(const LoosePoints& points, const std::vector<int>& members, const Plane3& plane,
                             const Eigen::Vector3d& centroid, const CloudPlaneOptions& options) {
  const auto basis = geometry::tangentBasis(plane.normal);
  const auto across = geometry::tangentBasis(centroid.normalized());
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  // Effect on the weighted sums of an error that all points share: constant, or linear over the rays.
  Eigen::Matrix3d shared = Eigen::Matrix3d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  double weights = 0;
  for (const int member : members) {
    const Eigen::Vector3d p = points.at(static_cast<std::size_t>(member)), ray = p.normalized();
    const double of_point = informationOf(points, member, plane, options);
    const Eigen::Vector3d row = rowOf(p, basis);
    const Eigen::Vector2d turned = across.transpose() * ray;
    information += of_point * row * row.transpose();
    spread += of_point * turned * turned.transpose();
    weights += of_point;
    const double off = sharedSigma(p.norm(), options) * plane.normal.dot(ray);
    shared += of_point * off * row * Eigen::RowVector3d(1, turned.x(), turned.y());
  }
  const CommonError error = commonError(spread / weights);
  Eigen::Matrix3d of_error = Eigen::Matrix3d::Zero();
  of_error(0, 0) = error.offset;
  of_error.bottomRightCorner<2, 2>() = error.slope;
  const Eigen::Matrix3d by_noise = information.inverse(), by_sums = by_noise * shared;
  return by_noise + by_sums * of_error * by_sums.transpose();
}

CloudPlane describe(const LoosePoints& points, const std::vector<int>& members, const geometry::Plane3& roughly,
                    const CloudPlaneOptions& options) {
  CloudPlane plane;
  plane.plane_in_sensor = fitPlane(points, members, roughly);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0;
  for (const int member : members) {
    const Eigen::Vector3d p = points.at(static_cast<std::size_t>(member));
    const double off = geometry::signedDistance(plane.plane_in_sensor, p);
    squares += off * off;
    sum += p;
  }
  plane.inliers = static_cast<int>(members.size());
  plane.rms = std::sqrt(squares / plane.inliers);
  plane.centroid = sum / plane.inliers;
  plane.centroid -= geometry::signedDistance(plane.plane_in_sensor, plane.centroid) * plane.plane_in_sensor.normal;
  plane.covariance = covarianceOf(points, members, plane.plane_in_sensor, plane.centroid, options);
  return plane;
}

}  // namespace

std::vector<PlanePatch> findPatches(const LoosePoints& points, const geometry::Plane3& plane,
                                    const CloudPlaneOptions& options, std::vector<bool>& used) {
  std::vector<int> near, off;  // on the plane, and a little off it
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float distance = points.off(i, plane);
    if (distance <= kHalo) (distance <= 1 ? near : off).push_back(static_cast<int>(i));
  }
  std::vector<PlanePatch> patches;
  if (near.empty()) return patches;
  const FlatGrid grid(points, near, plane, options.max_gap);
  const Components components = connectComponents(grid.width(), grid.height(), SameLabel{grid.filled().data()});
  const auto component_of_cell = components.labels();
  std::vector<std::vector<int>> members(components.pixels.size());
  for (const int i : near) {
    members[static_cast<std::size_t>(component_of_cell[grid.cellOf(i)] - 1)].push_back(i);
  }
  std::vector<bool> kept(components.pixels.size(), false);
  for (std::size_t c = 0; c < members.size(); ++c) {
    if (static_cast<int>(members[c].size()) < options.min_points) continue;
    PlanePatch patch{std::move(members[c]), {}};
    patch.result = describe(points, patch.members, plane, options);
    const double turn = patch.result.covariance(0, 0) + patch.result.covariance(1, 1);
    if (!(turn > 0 && turn < kMostTurn)) continue;
    const double range = patch.result.centroid.norm();
    if (patch.result.plane_in_sensor.distance < std::sin(options.min_incidence) * range) continue;
    kept[c] = true;
    for (const int i : patch.members) used[static_cast<std::size_t>(i)] = true;
    outline(grid, components, static_cast<int>(c), patch.members, options.outline, patch.result);
    patches.push_back(std::move(patch));
  }
  for (const int i : off) {
    const int cell = grid.cellOrNone(i);
    if (cell == FlatGrid::kNone) continue;
    const int component = component_of_cell[static_cast<std::size_t>(cell)];
    if (component > 0 && kept[static_cast<std::size_t>(component - 1)]) used[static_cast<std::size_t>(i)] = true;
  }
  return patches;
}

}  // namespace omnimapper::perception::clouds
