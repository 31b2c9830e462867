#include <gtest/gtest.h>
#include <omnimapper/testing/SimulatedLog.h>

#include "pcl_matching/PclMatcher.h"

namespace omnimapper::pcl_matching {
namespace {

using geometry::Se3;

// 1200 points each on three walls of 1 m that meet in a corner, with normals and covariances.
matching::CloudPoints corner() {
  testing::Dice dice(1);
  matching::CloudPoints cloud;
  for (int i = 0; i < 3600; ++i) {
    Eigen::Vector3d point(dice.uniform(0, 1), dice.uniform(0, 1), dice.uniform(0, 1));
    point(i % 3) = 0;
    const Eigen::Vector3f normal = Eigen::Vector3f::Unit(i % 3);
    cloud.points.push_back(point.cast<float>());
    cloud.normals.push_back(normal);
    cloud.covariances.push_back(1e-6F * Eigen::Matrix3f::Identity() +
                                1e-3F * (Eigen::Matrix3f::Identity() - normal * normal.transpose()));
  }
  return cloud;
}

matching::CloudPoints moved(matching::CloudPoints cloud, const Se3& to_from_cloud) {
  const Eigen::Matrix3f rotation = to_from_cloud.rotation.toRotationMatrix().cast<float>();
  for (auto& point : cloud.points) point = (to_from_cloud * point.cast<double>()).cast<float>();
  for (auto& normal : cloud.normals) normal = rotation * normal;
  for (auto& covariance : cloud.covariances) covariance = rotation * covariance * rotation.transpose();
  return cloud;
}

TEST(PclMatcher, EachMethodFindsTheMotionOfTheSameCloud) {
  const Se3 target_from_source{Eigen::Quaterniond(Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitZ())),
                               {0.02, -0.01, 0.015}};
  const matching::MatchCloud target(corner()), source(moved(corner(), inverse(target_from_source)));
  for (const auto method :
       {matching::CloudMethod::point_to_point, matching::CloudMethod::point_to_plane, matching::CloudMethod::gicp}) {
    matching::CloudMatcherOptions options;
    options.method = method;
    const auto match = PclMatcher(options).match(target, source, Se3{});
    const auto off = minus(match.target_from_source, target_from_source);
    EXPECT_LT(off.head<3>().norm(), 0.001) << static_cast<int>(method);
    EXPECT_LT(off.tail<3>().norm(), 0.001) << static_cast<int>(method);
  }
}

TEST(PclMatcher, OfTooFewPointsTheGuessIsReturned) {
  matching::CloudPoints few = corner();
  few.points.resize(20);
  few.normals.resize(20);
  few.covariances.resize(20);
  const Se3 guess{Eigen::Quaterniond::Identity(), {0.1, 0, 0}};
  const matching::MatchCloud cloud(few);
  EXPECT_EQ(PclMatcher({}).match(cloud, cloud, guess).target_from_source.translation, guess.translation);
}

}  // namespace
}  // namespace omnimapper::pcl_matching
