#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/matching/FeatureMatcher.h>

#include "RenderedRoom.h"

namespace omnimapper::matching::feature_matcher_test {
namespace {

using geometry::Se3;
using geometry::Vector6d;

RenderedRoom tiledRoom(unsigned tiles = 1) {
  RenderedRoom room;
  room.width = 640;
  room.height = 480;
  room.camera = {520, 520, 319.5, 239.5};
  room.tiles = tiles;
  return room;
}

FeatureMatch matched(const RenderedRoom& there, const Se3& pose_there, const RenderedRoom& here, const Se3& pose_here,
                     std::uint64_t seed = 1) {
  const FeatureMatcher matcher;
  const auto reference = matcher.prepare(there.pyramid(there.render(pose_there, seed)));
  return matcher.match(*reference, *matcher.prepare(here.pyramid(here.render(pose_here, seed + 1000))));
}

TEST(FeatureMatcher, FindsAMotionHoweverFar) {
  const auto room = tiledRoom();
  for (const Se3& motion : {posed(0.02, 0, 0.01, 0, 0.02, 0), posed(0.3, -0.1, 0.2, 0.05, 0.3, -0.1),
                            posed(0, 0, 0, 0, 0, 0.8), posed(-0.2, 0.2, 0.4, 0.1, -0.2, 0.3)}) {
    const auto found = matched(room, Se3{}, room, motion);
    ASSERT_TRUE(found.succeeded) << found.pairs << " pairs, " << found.inliers << " agree";
    const Vector6d off = minus(found.reference_from_image, motion);
    EXPECT_LT(off.head<3>().norm(), 0.01);
    EXPECT_LT(off.tail<3>().norm(), 0.005);
  }
}

TEST(FeatureMatcher, ItsCovarianceIsOfTheErrorsSize) {
  auto room = tiledRoom();
  room.depth_noise = camera::DepthNoise{}.sigma;
  room.grey_noise = 2;
  const Se3 motion = posed(0.1, 0.05, 0.05, 0.02, 0.1, 0.03);
  double sum = 0;
  constexpr int kRuns = 10;
  for (int run = 0; run < kRuns; ++run) {
    const auto found = matched(room, Se3{}, room, motion, static_cast<std::uint64_t>(run + 1));
    ASSERT_TRUE(found.succeeded);
    const Vector6d off = minus(found.reference_from_image, motion);
    sum += off.dot(found.covariance.inverse() * off) / 6;
  }
  EXPECT_GT(sum / kRuns, 0.1);
  EXPECT_LT(sum / kRuns, 4);
}

TEST(FeatureMatcher, WhatIsNotTheSamePlaceIsNotBelieved) {
  const auto found = matched(tiledRoom(1), Se3{}, tiledRoom(2), posed(0.1, 0, 0, 0, 0.1, 0));
  EXPECT_FALSE(found.succeeded) << found.inliers << " of " << found.pairs << " agree";
}

TEST(FeatureMatcher, WithoutCornersNothingIsFound) {
  const RenderedRoom smooth;
  EXPECT_FALSE(matched(smooth, Se3{}, smooth, posed(0.01, 0, 0, 0, 0, 0)).succeeded);
  const FeatureMatcher matcher;
  const auto room = tiledRoom();
  const auto image = room.render(Se3{});
  const auto blind = matcher.prepare(room.pyramid(image, false));
  EXPECT_FALSE(matcher.match(*blind, *matcher.prepare(room.pyramid(image))).succeeded) << "no picture";
}

TEST(FeatureMatcher, OfATinyImageThereIsNothing) {
  auto room = tiledRoom();
  for (const int width : {8, 16, 38}) {
    room.width = width;
    room.height = width / 2;
    EXPECT_FALSE(matched(room, Se3{}, room, Se3{}).succeeded) << width;
  }
}

TEST(FeatureMatcher, TheSameImagesGiveTheSameBits) {
  const auto room = tiledRoom();
  const Se3 motion = posed(0.1, 0.05, 0.05, 0.02, 0.1, 0.03);
  const auto one = matched(room, Se3{}, room, motion), other = matched(room, Se3{}, room, motion);
  EXPECT_EQ(one.reference_from_image.translation, other.reference_from_image.translation);
  EXPECT_EQ(one.covariance, other.covariance);
}

TEST(FeatureMatcher, RefusesOptionsThatMeanNothing) {
  FeatureMatcherOptions options;
  options.min_inliers = 0;
  EXPECT_THROW(FeatureMatcher{options}, base::Error);
  options = {};
  options.max_features = 0;
  EXPECT_THROW(FeatureMatcher{options}, base::Error);
  options = {};
  options.pixel_noise = 0;
  EXPECT_THROW(FeatureMatcher{options}, base::Error);
}

}  // namespace
}  // namespace omnimapper::matching::feature_matcher_test
