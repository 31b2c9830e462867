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
          .number("voxel_m", &Options::voxel, Range::notNegative(),
                  "Points are averaged over cubes of that side; 0 leaves them as they are.")
          .number("min_range_m", &Options::min_range, Range::notNegative(), "Nearer points are left out.")
          .number("max_range_m", &Options::max_range, Range::positive(), "Farther points are left out.")
          .number("range_sigma_m", &Options::range_sigma, Range::positive(),
                  "Standard deviation of a point along its ray, near the sensor.")
          .number("noise_at_1m_m", &Options::noise_at_1m, Range::notNegative(),
                  "The part of it that grows with the square of the range, at 1 m: 0.0023 for a Kinect.")
          .number("correlated_points", &Options::correlated_points, {1, 10000},
                  "How many neighbouring points share one error: 9 for a Kinect.")
          .number(
              "bias_sigma_m", &Options::bias_sigma, Range::notNegative(),
              "Standard deviation of what neighbouring points are off alike along their rays; covariances count it.")
          .number("bend_at_1m_m", &Options::bend_at_1m, Range::notNegative(),
                  "The most of it that grows with the square of the range, at 1 m: 0.004 for a Kinect.")
          .number("scale_sigma", &Options::scale_sigma, {0, 1},
                  "The part of it that grows with the range: 0.01 for a Kinect.")
          .number("gate_sigmas", &Options::gate, Range::positive(),
                  "A point more standard deviations than that from a plane is not on it.")
          .number("sample_radius_m", &Options::sample_radius, Range::positive(),
                  "Side of the cubes that three points are drawn from.")
          .integer("trials", &Options::trials, {1, 1000000}, "Most triples of points that are drawn for each plane.")
          .integer("seed", &Options::seed, {0, 2147483647}, "Of those triples.")
          .number("max_gap_m", &Options::max_gap, Range::positive(),
                  "Surfaces on one plane that are farther apart than that are several.")
          .number(
              "min_incidence_deg", &Options::min_incidence, {0, 89},
              "Between a plane and the rays to it: nothing is seen edge-on, but the points of one turn of a laser lie "
              "on planes through it.")
          .integer("min_points", &Options::min_points, {3, 100000000},
                   "Surfaces of fewer points, after averaging, are left out.")
          .choice<Outline>("outline", &Options::outline, {{"concave", Outline::concave}, {"convex", Outline::convex}},
                           "Where a surface ends: around its points with holes, or their convex hull.");
  return table;
}

namespace {

// Planes that many points lie on, here and there, but no surface: so many in a row are the end.
constexpr int kMostVain = 5;
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
  for (int vain = 0; vain < kMostVain && result.planes.size() < kMostPlanes;) {
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
    vain = patches.empty() ? vain + 1 : 0;
    if (!patches.empty()) left.remove(used);
  }
  result.labels.reserve(points.size());
  for (const int voxel : voxels.of_point) {
    result.labels.push_back(voxel == clouds::kNoVoxel ? std::uint16_t{0} : of_voxel[static_cast<std::size_t>(voxel)]);
  }
  return result;
}

}  // namespace omnimapper::perception
