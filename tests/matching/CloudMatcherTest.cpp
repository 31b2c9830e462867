// Registration of clouds: known motions, open directions, refused input.
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/matching/CloudMatcher.h>
#include <omnimapper/matching/CloudSource.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>
#include <limits>

#include "RenderedRoom.h"

namespace omnimapper::matching::cloud_matcher_test {
namespace {

using geometry::Se3;

constexpr double kDegree = M_PI / 180;

// Points on walls of 1 m that meet in a corner, some 3 cm apart, with normals and covariances.
CloudPoints corner(int walls, std::uint64_t seed, double noise = 0) {
  testing::Dice dice(seed);
  CloudPoints cloud;
  for (int wall = 0; wall < walls; ++wall) {
    for (int i = 0; i < 1200; ++i) {
      Eigen::Vector3d point(dice.uniform(0, 1), dice.uniform(0, 1), dice.uniform(0, 1));
      point(wall) = noise > 0 ? dice.normal(noise) : 0;
      const Eigen::Vector3f normal = Eigen::Vector3f::Unit(wall);
      cloud.points.push_back(point.cast<float>());
      cloud.normals.push_back(normal);
      cloud.covariances.push_back(1e-6F * Eigen::Matrix3f::Identity() +
                                  1e-3F * (Eigen::Matrix3f::Identity() - normal * normal.transpose()));
    }
  }
  return cloud;
}

CloudPoints moved(CloudPoints cloud, const Se3& to_from_cloud) {
  const Eigen::Matrix3f rotation = to_from_cloud.rotation.toRotationMatrix().cast<float>();
  for (auto& point : cloud.points) point = (to_from_cloud * point.cast<double>()).cast<float>();
  for (auto& normal : cloud.normals) normal = rotation * normal;
  for (auto& covariance : cloud.covariances) covariance = rotation * covariance * rotation.transpose();
  return cloud;
}

Se3 motion(double x, double y, double z, double turn_degrees) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(turn_degrees * kDegree, Eigen::Vector3d(1, 2, -1).normalized())),
          {x, y, z}};
}

CloudMatcherOptions by(CloudMethod method) {
  CloudMatcherOptions options;
  options.method = method;
  return options;
}

// The source is the same cloud, moved: each method must recover the motion to the precision of floats.
TEST(CloudMatcher, EachMethodFindsTheMotionOfTheSameCloud) {
  const Se3 target_from_source = motion(0.02, -0.01, 0.015, 1.5);
  const MatchCloud target(corner(3, 1)), source(moved(corner(3, 1), inverse(target_from_source)));
  for (const auto method : {CloudMethod::point_to_point, CloudMethod::point_to_plane, CloudMethod::gicp}) {
    auto options = by(method);
    options.max_points = 10000;
    const auto match = IteratedClosestPoints(options).match(target, source, {});
    const auto off = minus(match.target_from_source, target_from_source);
    EXPECT_TRUE(match.succeeded) << static_cast<int>(method);
    EXPECT_LT(off.head<3>().norm(), method == CloudMethod::point_to_point ? 1e-3 : 1e-5) << static_cast<int>(method);
    EXPECT_LT(off.tail<3>().norm(), method == CloudMethod::point_to_point ? 1e-3 : 1e-5) << static_cast<int>(method);
    EXPECT_GT(match.overlap, 0.99);
  }
}

// The clouds have different points of the same walls.
TEST(CloudMatcher, WallsAreFoundThoughNoPointIsSeenTwice) {
  const Se3 target_from_source = motion(0.03, 0.01, -0.02, 2);
  const MatchCloud target(corner(3, 1, 0.001)), source(moved(corner(3, 2, 0.001), inverse(target_from_source)));
  const auto off = [&](CloudMethod method) {
    const auto match = IteratedClosestPoints(by(method)).match(target, source, {});
    EXPECT_TRUE(match.succeeded);
    return minus(match.target_from_source, target_from_source).head<3>().norm();
  };
  EXPECT_LT(off(CloudMethod::point_to_plane), 0.0005);
  EXPECT_LT(off(CloudMethod::gicp), 0.0005);
  EXPECT_LT(off(CloudMethod::point_to_point), 0.01) << "the nearest points hold it back";
}

// With point_to_plane, because GICP's nearest points seem to constrain motions along a wall, too.
TEST(CloudMatcher, OneWallLeavesThreeDirectionsOpenAndTwoLeaveOneAndThereItIsAsGuessed) {
  const Se3 target_from_source = motion(0.01, 0.01, 0.01, 0.5);
  const auto matched = [&](int walls) {
    const MatchCloud target(corner(walls, 1, 0.001));
    const MatchCloud source(moved(corner(walls, 2, 0.001), inverse(target_from_source)));
    const auto match = IteratedClosestPoints(by(CloudMethod::point_to_plane)).match(target, source, {});
    EXPECT_TRUE(match.fits);
    EXPECT_EQ(match.succeeded, match.open_directions == 0);
    return match;
  };
  const auto one = matched(1);
  EXPECT_EQ(one.open_directions, 3);
  EXPECT_LT(std::abs(one.target_from_source.translation.y()), 0.001) << "the motion along the wall is not known";
  EXPECT_LT(std::abs(one.target_from_source.translation.z()), 0.001);
  EXPECT_EQ(matched(2).open_directions, 1);
  EXPECT_EQ(matched(3).open_directions, 0);
}

TEST(CloudMatcher, ItsCovarianceIsOfTheErrorsSize) {
  const Se3 target_from_source = motion(0.02, -0.01, 0.015, 1);
  double normalized = 0;
  constexpr int kSeeds = 40;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const MatchCloud target(corner(3, 100 + seed, 0.002)),
        source(moved(corner(3, 200 + seed, 0.002), inverse(target_from_source)));
    auto options = by(CloudMethod::point_to_plane);
    options.alike = 1;  // each point has an error of its own
    const auto match = IteratedClosestPoints(options).match(target, source, {});
    const auto off = minus(match.target_from_source, target_from_source);
    normalized += off.dot(match.covariance.ldlt().solve(off)) / 6 / kSeeds;
  }
  EXPECT_GT(normalized, 0.5);
  EXPECT_LT(normalized, 3) << "a target's point counts for several of the source";
}

TEST(CloudMatcher, WhatDoesNotOverlapFailsAndStaysAtTheGuess) {
  const MatchCloud target(corner(3, 1)), source(moved(corner(3, 2), motion(5, 0, 0, 0)));
  const Se3 guess = motion(0.1, 0.2, 0.3, 4);
  for (const auto method : {CloudMethod::point_to_point, CloudMethod::point_to_plane, CloudMethod::gicp}) {
    const auto match = IteratedClosestPoints(by(method)).match(target, source, guess);
    EXPECT_FALSE(match.succeeded);
    EXPECT_EQ(minus(match.target_from_source, guess).norm(), 0);
    EXPECT_EQ(match.covariance(0, 0), CloudMatch::kOpen);
  }
}

TEST(CloudMatcher, NothingIsFoundInNothing) {
  const MatchCloud empty{CloudPoints{}}, full(corner(3, 1));
  CloudPoints few;
  few.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const MatchCloud three(few);
  const IteratedClosestPoints matcher(by(CloudMethod::point_to_point));
  for (const auto& [target, source] : {std::pair{&empty, &full}, {&full, &empty}, {&empty, &empty}, {&full, &three}})
    EXPECT_FALSE(matcher.match(*target, *source, {}).succeeded);
  EXPECT_EQ(empty.nearest(Eigen::Vector3f::Zero(), 1.0F), MatchCloud::kNone);
}

TEST(CloudMatcher, RefusesWhatAMethodCannotUse) {
  CloudPoints bare;
  bare.points = corner(3, 1).points;
  const MatchCloud cloud(bare);
  EXPECT_THROW(IteratedClosestPoints(by(CloudMethod::point_to_plane)).match(cloud, cloud, {}), base::Error);
  EXPECT_THROW(IteratedClosestPoints(by(CloudMethod::gicp)).match(cloud, cloud, {}), base::Error);
  CloudPoints broken = bare;
  broken.points[5].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(MatchCloud{broken}, base::Error);
  CloudPoints uneven = bare;
  uneven.normals.resize(3);
  EXPECT_THROW(MatchCloud{uneven}, base::Error);
  CloudMatcherOptions none;
  none.max_points = 0;
  EXPECT_THROW(IteratedClosestPoints{none}, base::Error);
}

TEST(MatchCloud, FindsTheNearestAsASearchThroughAllDoes) {
  const auto cloud = corner(3, 3, 0.01);
  const MatchCloud index(cloud);
  testing::Dice dice(4);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f to(static_cast<float>(dice.uniform(-0.2, 1.2)), static_cast<float>(dice.uniform(-0.2, 1.2)),
                             static_cast<float>(dice.uniform(-0.2, 1.2)));
    std::size_t best = MatchCloud::kNone;
    float least = 0.1F * 0.1F;
    for (std::size_t j = 0; j < cloud.points.size(); ++j) {
      const float square = (cloud.points[j] - to).squaredNorm();
      if (square < least) least = square, best = j;
    }
    EXPECT_EQ(index.nearest(to, 0.1F), best);
  }
}

// The room has no discontinuities in depth or brightness, only surfaces and a smooth picture.
TEST(CloudSource, VoxelsOfARoomDetermineTheMotion) {
  RenderedRoom room;
  // The camera looks into a corner of the ceiling, where three surfaces meet.
  const Se3 from{Eigen::AngleAxisd(52 * kDegree, Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(27 * kDegree, Eigen::Vector3d::UnitX()),
                 Eigen::Vector3d::Zero()};
  const Se3 to = from * motion(0.03, 0.02, -0.02, 2);
  const auto first = room.render(from), second = room.render(to);
  CloudSourceOptions options;
  options.source = CloudSource::voxels;
  options.voxel = 0.05;
  const MatchCloud target(cloudOf(room.depthImage(first), nullptr, options)),
      source(cloudOf(room.depthImage(second), nullptr, options));
  EXPECT_EQ(target.cloud().normals.size(), target.size());
  for (const auto method : {CloudMethod::point_to_plane, CloudMethod::gicp}) {
    const auto match = IteratedClosestPoints(by(method)).match(target, source, {});
    const auto off = minus(match.target_from_source, inverse(from) * to);
    EXPECT_LT(off.head<3>().norm(), 0.004) << static_cast<int>(method);
    EXPECT_LT(off.tail<3>().norm(), 0.1 * kDegree) << static_cast<int>(method);
  }
}

// 60 x 40 pixels of a wall at 2 m, the right half at 1 m.
TEST(CloudSource, AnEdgeIsLongAlongItself) {
  constexpr int kWidth = 60, kHeight = 40;
  std::vector<float> depths;
  for (int i = 0; i < kWidth * kHeight; ++i) depths.push_back(i % kWidth < kWidth / 2 ? 2.0F : 1.0F);
  const camera::DepthImage image(depths.data(), kWidth, kHeight, {50, 50, 29.5, 19.5});
  CloudSourceOptions options;
  options.source = CloudSource::occluding_edges;
  const auto cloud = cloudOf(image, nullptr, options);
  ASSERT_EQ(cloud.points.size(), static_cast<std::size_t>(kHeight)) << "one pixel of each row";
  const auto& middle = cloud.covariances[kHeight / 2];
  EXPECT_EQ(cloud.points[kHeight / 2].z(), 1);
  EXPECT_GT(middle(1, 1), 10 * middle(0, 0)) << "along the image's columns";
  options.source = CloudSource::rgb_edges;
  EXPECT_THROW(cloudOf(image, nullptr, options), base::Error) << "there is no picture";
}

TEST(CloudSource, NothingMeasuredIsAnEmptyCloud) {
  const std::vector<float> depths(80 * 60, 0.0F);
  const camera::DepthImage image(depths.data(), 80, 60, {60, 60, 39.5, 29.5});
  for (const auto source : {CloudSource::occluding_edges, CloudSource::high_curvature_edges, CloudSource::voxels,
                            CloudSource::all_points}) {
    CloudSourceOptions options;
    options.source = source;
    EXPECT_TRUE(cloudOf(image, nullptr, options).points.empty());
  }
}

}  // namespace
}  // namespace omnimapper::matching::cloud_matcher_test
