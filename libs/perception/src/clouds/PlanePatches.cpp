#include "PlanePatches.h"

#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/perception/ConnectedComponents.h>
#include <omnimapper/perception/SameLabel.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "FlatGrid.h"

namespace omnimapper::perception::clouds {

namespace {

// Points up to so much farther off than inliers, squared, belong to no other plane.
constexpr float kHalo = 2.5F;
// Sum of the variances of a plane's turns [rad^2]. The points of a line, such as what a laser's turn leaves of a wall,
// tell no plane.
constexpr double kMostTurn = 0.1;

// Covariance of the plane's two turns and its distance: each point tells n.p + d = 0 with its own deviation.
Eigen::Matrix3d covarianceOf(const LoosePoints& points, const std::vector<int>& members, const geometry::Plane3& plane,
                             double gate) {
  const auto basis = geometry::tangentBasis(plane.normal);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const int member : members) {
    const Eigen::Vector3d p = points.at(static_cast<std::size_t>(member));
    const double information_of_point =
        gate * gate / static_cast<double>(points.tolerance(static_cast<std::size_t>(member), plane));
    const Eigen::Vector3d row(basis.col(0).dot(p), basis.col(1).dot(p), 1);
    information += information_of_point * row * row.transpose();
  }
  return information.inverse();
}

CloudPlane describe(const LoosePoints& points, const std::vector<int>& members, const geometry::Plane3& roughly,
                    double gate) {
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
  plane.covariance = covarianceOf(points, members, plane.plane_in_sensor, gate);
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
    patch.result = describe(points, patch.members, plane, options.gate);
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
