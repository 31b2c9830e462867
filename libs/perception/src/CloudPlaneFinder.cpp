#include <omnimapper/base/Error.h>
#include <omnimapper/perception/CloudPlaneFinder.h>

#include "clouds/PlanePatches.h"
#include "clouds/VoxelGrid.h"

namespace omnimapper::perception {

const base::OptionTable<CloudPlaneOptions>& CloudPlaneOptions::table() {
  using Options = CloudPlaneOptions;
  using base::Range;
  static const auto table =
      base::OptionTable<Options>()
          .number(
              "voxel_m", &Options::voxel, Range::notNegative(),
              "Side of the cubes (voxels) in each of which the points are averaged; 0 leaves the points as they are.")
          .number("min_range_m", &Options::min_range, Range::notNegative(), "Points nearer than this are left out.")
          .number("max_range_m", &Options::max_range, Range::positive(), "Points farther than this are left out.")
          .number("range_sigma_m", &Options::range_sigma, Range::positive(),
                  "Standard deviation of a point along its ray, apart from the noise that grows with the range.")
          .number("noise_at_1m_m", &Options::noise_at_1m, Range::notNegative(),
                  "Standard deviation, at a range of 1 m, of the part of the noise that grows with the square of the "
                  "range; 0.0023 for a Kinect.")
          .number("correlated_points", &Options::correlated_points, {1, 10000},
                  "Number of neighbouring points that share one error; 9 for a Kinect.")
          .number("bias_sigma_m", &Options::bias_sigma, Range::notNegative(),
                  "Standard deviation of the range error that neighbouring points have in common. Reported covariances "
                  "include it.")
          .number("distortion_at_1m_m", &Options::distortion_at_1m, Range::notNegative(),
                  "Largest systematic range error that neighbouring points have in common, at a range of 1 m. It grows "
                  "with the square of the range; 0.004 for a Kinect.")
          .number("scale_sigma", &Options::scale_sigma, {0, 1},
                  "Standard deviation of the relative range error that neighbouring points have in common; 0.01 "
                  "for a Kinect.")
          .number(
              "gate_sigmas", &Options::gate, Range::positive(),
              "A point that is farther from a plane than this many standard deviations does not belong to the plane.")
          .number("sample_cube_m", &Options::sample_cube, Range::positive(),
                  "The three points that a possible plane is computed from are drawn from a cube with this side.")
          .integer("trials", &Options::trials, {1, 1000000},
                   "Largest number of point triples that are drawn for each plane.")
          .integer("seed", &Options::seed, {0, 2147483647},
                   "Seed of the random numbers by which point triples are drawn.")
          .number("max_gap_m", &Options::max_gap, Range::positive(),
                  "Parts of a plane that are farther apart than this are separate surfaces.")
          .number("min_incidence_deg", &Options::min_incidence, {0, 89},
                  "Planes at a smaller angle than this to the rays are rejected. A real surface is not visible "
                  "edge-on, but the points of one ring of a 3D laser lie on a plane through the laser.")
          .integer("min_points", &Options::min_points, {3, 100000000},
                   "Surfaces with fewer points than this are left out. Points are counted after averaging over voxels.")
          .choice<Outline>("outline", &Options::outline, {{"concave", Outline::concave}, {"convex", Outline::convex}},
                           "Outline of a surface. concave: it follows the points and has holes. convex: it is the "
                           "convex hull of the points.");
  return table;
}

namespace {

// The search ends after this many planes in a row whose points are too scattered to form a surface.
constexpr int kMostFailures = 5;
constexpr std::size_t kMostPlanes = 65535;

}  // namespace

CloudPlaneFinder::CloudPlaneFinder(const CloudPlaneOptions& options) : options_(options) {
  using base::option_text::format;
  if (options.min_range >= options.max_range) {
    throw base::Error(base::ExitCode::out_of_range, "min_range_m = " + format(options.min_range) +
                                                        ": must be below max_range_m = " + format(options.max_range));
  }
}

CloudPlanes CloudPlaneFinder::find(const std::vector<Eigen::Vector3f>& points) const {
  const auto voxels = clouds::averaged(points, options_.voxel, options_.min_range, options_.max_range);
  clouds::LoosePoints left = clouds::loosen(voxels, options_);
  base::SplitMix random(static_cast<std::uint64_t>(options_.seed));
  CloudPlanes result;
  std::vector<std::uint16_t> of_voxel(voxels.means.size(), 0);
  for (int failures = 0; failures < kMostFailures && result.planes.size() < kMostPlanes;) {
    const auto plane = clouds::findPlane(left, options_, random);
    if (!plane) break;
    std::vector<bool> used(left.size(), false);
    auto patches = clouds::findPatches(left, *plane, options_, used);
    for (auto& patch : patches) {
      if (result.planes.size() == kMostPlanes) break;
      result.planes.push_back(std::move(patch.result));
      for (const int member : patch.members) {
        of_voxel[static_cast<std::size_t>(left.number[static_cast<std::size_t>(member)])] =
            static_cast<std::uint16_t>(result.planes.size());
      }
    }
    failures = patches.empty() ? failures + 1 : 0;
    if (!patches.empty()) left.remove(used);
  }
  result.labels.reserve(points.size());
  for (const int voxel : voxels.of_point) {
    result.labels.push_back(voxel == clouds::kNoVoxel ? std::uint16_t{0} : of_voxel[static_cast<std::size_t>(voxel)]);
  }
  return result;
}

}  // namespace omnimapper::perception
