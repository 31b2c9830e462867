#include "PclMatcher.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>

namespace omnimapper::pcl_matching {

namespace {

using geometry::Se3;
using matching::CloudMatch;
using matching::CloudMatcherOptions;
using matching::CloudMethod;
using matching::MatchCloud;

// Points without a normal are left out if `with_normals`.
pcl::PointCloud<pcl::PointNormal>::Ptr toPcl(const MatchCloud& cloud, bool with_normals) {
  auto points = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  const auto& all = cloud.cloud();
  points->reserve(all.points.size());
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    pcl::PointNormal point;
    point.getVector3fMap() = all.points[i];
    if (with_normals) {
      if (!all.normals[i].allFinite()) continue;
      point.getNormalVector3fMap() = all.normals[i];
    }
    points->push_back(point);
  }
  return points;
}

// None if PCL does not converge.
template <class Registration>
std::optional<Se3> align(Registration& registration, const CloudMatcherOptions& options, bool with_normals,
                         const MatchCloud& target, const MatchCloud& source, const Se3& guess) {
  const auto from = toPcl(source, with_normals), to = toPcl(target, with_normals);
  constexpr std::size_t kFewest = 30;  // points, because GICP computes covariances of 20 neighbours
  if (from->size() < kFewest || to->size() < kFewest) return std::nullopt;
  registration.setInputSource(from);
  registration.setInputTarget(to);
  registration.setMaxCorrespondenceDistance(options.max_distance);
  registration.setMaximumIterations(options.max_iterations);
  Eigen::Matrix4f start = Eigen::Matrix4f::Identity();
  start.topLeftCorner<3, 3>() = guess.rotation.toRotationMatrix().cast<float>();
  start.topRightCorner<3, 1>() = guess.translation.cast<float>();
  pcl::PointCloud<pcl::PointNormal> aligned;
  registration.align(aligned, start);
  const Eigen::Matrix4d found = registration.getFinalTransformation().template cast<double>();
  if (!registration.hasConverged() || !found.allFinite()) return std::nullopt;
  return Se3{Eigen::Quaterniond(Eigen::Matrix3d(found.topLeftCorner<3, 3>())).normalized(),
             found.topRightCorner<3, 1>()};
}

}  // namespace

CloudMatch PclMatcher::match(const MatchCloud& target, const MatchCloud& source, const Se3& guess) const {
  const auto found = registered(target, source, guess);
  if (found) return judge_.judged(target, source, guess, *found);
  CloudMatch match;
  match.target_from_source = guess;
  return match;
}

std::optional<Se3> PclMatcher::registered(const MatchCloud& target, const MatchCloud& source, const Se3& guess) const {
  using Point = pcl::PointNormal;
  // PCL's ICP compares its epsilon with the square of a step, its GICP with the step itself [m] [rad].
  const double square = options_.tolerance * options_.tolerance;
  switch (options_.method) {
    case CloudMethod::point_to_plane: {
      pcl::IterativeClosestPointWithNormals<Point, Point> icp;
      icp.setTransformationEpsilon(square);
      return align(icp, options_, true, target, source, guess);
    }
    case CloudMethod::gicp: {
      pcl::GeneralizedIterativeClosestPoint<Point, Point> gicp;
      gicp.setTransformationEpsilon(options_.tolerance);
      gicp.setRotationEpsilon(options_.tolerance);
      return align(gicp, options_, false, target, source, guess);
    }
    case CloudMethod::point_to_point:
      break;
  }
  pcl::IterativeClosestPoint<Point, Point> icp;
  icp.setTransformationEpsilon(square);
  return align(icp, options_, false, target, source, guess);
}

}  // namespace omnimapper::pcl_matching

extern "C" omnimapper::matching::CloudMatcher* omnimapperPclMatcher(
    const omnimapper::matching::CloudMatcherOptions& options) {
  return new omnimapper::pcl_matching::PclMatcher(options);
}
