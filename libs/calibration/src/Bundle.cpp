#include "Bundle.h"

#include <algorithm>
#include <cmath>

#include "BundleProblem.h"

namespace omnimapper::calibration {

namespace {

// The point in the picture's optical frame, and in the depth camera's, at the time when the row was taken that shows
// it.
Eigen::Vector3d inPicture(const Measurement& one, const Estimate& estimate) {
  const Eigen::Vector3d p = estimate.picture_from_world[one.view] * estimate.points[one.track];
  return later(p, one.velocity, estimate.timing[0] * one.row_share);
}

Eigen::Vector3d inDepths(const Measurement& one, const Estimate& estimate) {
  const Eigen::Vector3d p = estimate.picture_from_world[one.view] * estimate.points[one.track];
  const double seconds = estimate.timing[2] + estimate.timing[1] * one.depth_row_share;
  return estimate.camera.depth_from_picture * later(p, one.velocity, seconds);
}

// Sets the surface at the pixel of the depth image where the estimate predicts the point.
void associate(Measurement& one, const CalibrationView& view, const Estimate& estimate) {
  const Eigen::Vector3d p = inDepths(one, estimate);
  one.plane = p.z() > 0.1 ? view.planeAt(project(estimate.camera.depthCamera().data(), p)) : std::nullopt;
  if (one.plane) one.depth_row_share = one.plane->pixel.y() / view.depth_height - 0.5;
}

Eigen::Vector2d missOf(const Measurement& one, const Estimate& estimate) {
  return one.pixel - project(estimate.camera.picture.data(), inPicture(one, estimate));
}

// [1/m] Measured minus predicted inverse depth; none without a surface.
std::optional<double> depthMissOf(const Measurement& one, const Estimate& estimate) {
  if (!one.plane) return std::nullopt;
  const auto& camera = estimate.camera;
  const Eigen::Vector3d p = inDepths(one, estimate);
  return one.plane->at(project(camera.depthCamera().data(), p)) - camera.depth_scale / p.z();
}

}  // namespace

void associateSurfaces(BundleInput& input, const Estimate& estimate) {
  for (auto& one : input.measurements) associate(one, input.views[one.view], estimate);
}

void leaveOutContradictions(BundleInput& input, const Estimate& estimate, double pixels, double sigmas) {
  auto& all = input.measurements;
  for (auto& one : all) {
    const auto depth_miss = depthMissOf(one, estimate);
    if (depth_miss && std::abs(*depth_miss) > sigmas * one.plane->sigma) one.plane.reset();
  }
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const Measurement& one) {
                             return !(inPicture(one, estimate).z() > 0.1) ||
                                    !(missOf(one, estimate).norm() < pixels * one.sigma);
                           }),
            all.end());
  // A point that only one view measures constrains nothing but itself.
  std::vector<int> counts(estimate.points.size(), 0);
  for (const auto& one : all) ++counts[one.track];
  all.erase(std::remove_if(all.begin(), all.end(), [&](const Measurement& one) { return counts[one.track] < 2; }),
            all.end());
}

Adjusted adjust(const BundleInput& input, const Estimate& start, const std::set<Group>& free) {
  BundleProblem problem(start);
  for (const auto& one : input.measurements) problem.add(one);
  if (free.count(Group::scale) > 0)
    for (const auto& span : input.spans) problem.add(span, input.views);
  problem.keepViewsNearStart();
  problem.setFree(free, input.log);
  for (std::size_t i = 0; i < input.are_held.size(); ++i)
    if (input.are_held[i]) problem.holdView(i);
  problem.solve(input.stop);
  auto adjusted = problem.adjusted();
  for (auto& one : adjusted.parameters)
    if (one.group == Group::scale && !input.spans.empty())
      one.sigma = std::hypot(one.sigma, input.spans.front().common_sigma);
  return adjusted;
}

ViewMisses fitView(const std::vector<Measurement>& of_view, const CalibrationView& view, const Estimate& estimate,
                   const geometry::Se3& picture_from_world) {
  Estimate single{estimate.camera, {picture_from_world}, {}, estimate.timing};
  std::vector<Measurement> measurements = of_view;
  for (auto& one : measurements) {
    single.points.push_back(estimate.points[one.track]);
    one.track = single.points.size() - 1;
    one.view = 0;
  }
  for (int round = 0; round < 2; ++round) {
    for (auto& one : measurements) associate(one, view, single);
    BundleProblem problem(single);
    for (const auto& one : measurements) problem.add(one);
    problem.keepViewsNearStart();
    problem.holdCamera();
    for (std::size_t i = 0; i < measurements.size(); ++i) problem.holdPoint(i);
    problem.solve({});
    single = problem.adjusted().estimate;
  }
  ViewMisses result;
  for (const auto& one : measurements) {
    result.pixels.push_back(one.pixel);
    result.misses.push_back(missOf(one, single));
    if (const auto miss = depthMissOf(one, single)) result.depth_misses.push_back(*miss);
  }
  BundleProblem problem(single);
  for (const auto& one : measurements) problem.add(one);
  problem.holdCamera();
  result.cost = problem.adjusted().cost;
  return result;
}

}  // namespace omnimapper::calibration
