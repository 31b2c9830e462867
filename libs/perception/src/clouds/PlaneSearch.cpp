#include "PlaneSearch.h"

#include <omnimapper/geometry/SymmetricEigen.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "../planes/Lanes.h"

namespace omnimapper::perception::clouds {

namespace {

using planes::kLanes;
using planes::LaneMask;
using planes::Lanes;

// A quick count takes one in this many groups of points.
constexpr int kQuickly = 4;
// Accepted probability of missing the largest plane, and assumed probability that three neighbours, of which the first
// is on the plane, are on one surface.
constexpr double kMissed = 1e-3, kPure = 0.5;

struct CountTask {
  const float *x, *y, *z, *along;
  float nx, ny, nz, distance, everywhere;
};

// Counts inliers in every `step`-th group of eight points; an incomplete group at the end is left out.
OMNIMAPPER_KERNEL_BODY int countBody(const CountTask& task, int n, int step) {
  LaneMask sum{};
  const float squared_distance = task.distance * task.distance;
  for (int i = 0; i + kLanes <= n; i += step * kLanes) {
    Lanes x, y, z, along;
    planes::load(x, task.x + i);
    planes::load(y, task.y + i);
    planes::load(z, task.z + i);
    planes::load(along, task.along + i);
    const Lanes off = x * task.nx + y * task.ny + z * task.nz + task.distance;
    sum -= off * off <= along * squared_distance + task.everywhere;
  }
  int count = 0;
  for (int k = 0; k < kLanes; ++k) count += sum[k];
  return count;
}

#ifdef OMNIMAPPER_KERNEL_AVX2
OMNIMAPPER_KERNEL_AVX2 int countAvx2(const CountTask& task, int n, int step) {
  return countBody(task, n, step);
}
#endif

int count(const LoosePoints& points, const geometry::Plane3& plane, int step) {
  const CountTask task{points.x.data(),
                       points.y.data(),
                       points.z.data(),
                       points.along.data(),
                       static_cast<float>(plane.normal.x()),
                       static_cast<float>(plane.normal.y()),
                       static_cast<float>(plane.normal.z()),
                       static_cast<float>(plane.distance),
                       points.everywhere};
  const auto n = static_cast<int>(points.size());
#ifdef OMNIMAPPER_KERNEL_AVX2
  if (planes::hasAvx2()) return countAvx2(task, n, step);
#endif
  return countBody(task, n, step);
}

// Begin and end of the group of a point.
std::pair<int, int> groupAround(const LoosePoints& points, int i) {
  const auto range =
      std::equal_range(points.group.begin(), points.group.end(), points.group[static_cast<std::size_t>(i)]);
  return {static_cast<int>(range.first - points.group.begin()), static_cast<int>(range.second - points.group.begin())};
}

// The plane through three random points of one group; none if they are nearly on a line, or if it is seen edge-on.
std::optional<geometry::Plane3> drawPlane(const LoosePoints& points, double min_incidence, base::SplitMix& random) {
  const int first = random.below(static_cast<int>(points.size()));
  const auto [begin, end] = groupAround(points, first);
  if (end - begin < 3) return std::nullopt;
  const int second = begin + random.below(end - begin), third = begin + random.below(end - begin);
  const Eigen::Vector3d a = points.at(static_cast<std::size_t>(first)),
                        ab = points.at(static_cast<std::size_t>(second)) - a,
                        ac = points.at(static_cast<std::size_t>(third)) - a;
  const Eigen::Vector3d normal = ab.cross(ac);
  const double area = normal.norm();
  if (!(area > 0.1 * std::max(ab.squaredNorm(), ac.squaredNorm()))) return std::nullopt;
  const auto plane = geometry::Plane3::through(a, normal / area);
  if (std::abs(plane.distance) < std::sin(min_incidence) * a.norm()) return std::nullopt;
  return plane;
}

std::vector<int> inliersOf(const LoosePoints& points, const geometry::Plane3& plane) {
  std::vector<int> inliers;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points.off(i, plane) <= 1) inliers.push_back(static_cast<int>(i));
  }
  return inliers;
}

// Number of triples that suffices once a plane with that many inliers is known.
int enoughTrials(int inliers, std::size_t points, int most) {
  const double hit = kPure * inliers / static_cast<double>(points);
  if (hit >= 1) return 1;
  return static_cast<int>(std::min<double>(most, std::ceil(std::log(kMissed) / std::log1p(-hit))));
}

}  // namespace

float LoosePoints::off(std::size_t i, const geometry::Plane3& plane) const {
  const float distance = x[i] * static_cast<float>(plane.normal.x()) + y[i] * static_cast<float>(plane.normal.y()) +
                         z[i] * static_cast<float>(plane.normal.z()) + static_cast<float>(plane.distance);
  return distance * distance / tolerance(i, plane);
}

void LoosePoints::remove(const std::vector<bool>& flags) {
  const auto keep = [&](auto& values) {
    std::size_t to = 0;
    for (std::size_t i = 0; i < flags.size(); ++i) {
      if (!flags[i]) values[to++] = values[i];
    }
    values.resize(to);
  };
  keep(x);
  keep(y);
  keep(z);
  keep(along);
  keep(of);
  keep(group);
  keep(number);
}

LoosePoints loosen(const Voxels& voxels, const CloudPlaneOptions& options) {
  const auto& points = voxels.means;
  int groups = 0;
  const auto group = cubesOf(points, options.sample_cube, groups);
  // Counting sort by group.
  std::vector<int> place(static_cast<std::size_t>(groups) + 1, 0);
  for (const int g : group) {
    if (g != kNoVoxel) ++place[static_cast<std::size_t>(g) + 1];
  }
  for (std::size_t g = 1; g < place.size(); ++g) place[g] += place[g - 1];
  LoosePoints loose;
  loose.everywhere = static_cast<float>(options.gate * options.gate * options.range_sigma * options.range_sigma);
  const auto n = static_cast<std::size_t>(place.back());
  for (auto* values : {&loose.x, &loose.y, &loose.z, &loose.along, &loose.of}) values->resize(n);
  loose.group.resize(n);
  loose.number.resize(n);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (group[i] == kNoVoxel) continue;
    const auto to = static_cast<std::size_t>(place[static_cast<std::size_t>(group[i])]++);
    loose.x[to] = points[i].x();
    loose.y[to] = points[i].y();
    loose.z[to] = points[i].z();
    loose.along[to] = static_cast<float>(options.gate * options.gate * options.noise_at_1m * options.noise_at_1m) *
                      points[i].squaredNorm();
    loose.of[to] = static_cast<float>(voxels.sizes[i]);
    loose.group[to] = group[i];
    loose.number[to] = static_cast<int>(i);
  }
  return loose;
}

geometry::Plane3 fitPlane(const LoosePoints& points, const std::vector<int>& members, const geometry::Plane3& roughly) {
  // Sums are taken about one of the points, so that no digits are lost far from the origin.
  const Eigen::Vector3d origin = points.at(static_cast<std::size_t>(members.front()));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double weights = 0;
  for (const int member : members) {
    const auto i = static_cast<std::size_t>(member);
    const double weight = static_cast<double>(points.of[i] / points.tolerance(i, roughly));
    const Eigen::Vector3d p = points.at(i) - origin;
    sum += weight * p;
    squares += weight * p * p.transpose();
    weights += weight;
  }
  const Eigen::Vector3d mean = sum / weights;
  const Eigen::Matrix3d spread = squares / weights - mean * mean.transpose();
  const Eigen::Vector3d normal = geometry::eigenOf<3>(spread).vectors.col(0);
  const auto plane = geometry::Plane3::through(origin + mean, normal.normalized());
  return plane.distance < 0 ? geometry::Plane3{-plane.normal, -plane.distance} : plane;
}

std::optional<geometry::Plane3> findPlane(const LoosePoints& points, const CloudPlaneOptions& options,
                                          base::SplitMix& random) {
  if (points.size() < static_cast<std::size_t>(options.min_points)) return std::nullopt;
  std::optional<geometry::Plane3> best;
  int most = 0;
  for (int trial = 0, enough = options.trials; trial < enough; ++trial) {
    const auto plane = drawPlane(points, options.min_incidence, random);
    if (!plane || kQuickly * count(points, *plane, kQuickly) < most) continue;
    const int inliers = count(points, *plane, 1);
    if (inliers <= most) continue;
    most = inliers;
    best = plane;
    enough = enoughTrials(most, points.size(), options.trials);
  }
  for (int round = 0; round < 2 && best; ++round) {
    const auto inliers = inliersOf(points, *best);
    if (static_cast<int>(inliers.size()) < std::max(3, options.min_points)) return std::nullopt;
    best = fitPlane(points, inliers, *best);
  }
  return best;
}

}  // namespace omnimapper::perception::clouds
