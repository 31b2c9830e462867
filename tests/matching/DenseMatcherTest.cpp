#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>

#include "RenderedRoom.h"

namespace omnimapper::matching::dense_matcher_test {
namespace {

using geometry::Matrix6d;
using geometry::Se3;
using geometry::Vector6d;

const Se3 kStart = posed(0.1, 0.05, -0.4, 0.1, 0.5, 0.02);
const Se3 kMotion = posed(0.03, -0.02, 0.04, 0.02, -0.04, 0.03);  // 5 cm, 3 deg

/// The error of a match [m] [rad].
struct Off {
  double position, angle;
};

Off offOf(const DenseMatch& match, const Se3& truth) {
  const Vector6d off = minus(match.reference_from_image, truth);
  return {off.head<3>().norm(), off.tail<3>().norm()};
}

DenseMatch matched(const RenderedRoom& room, const RenderedRoom& later, const DenseMatcherOptions& options,
                   const Se3& motion = kMotion, std::uint64_t seed = 1) {
  const DenseMatcher matcher(options);
  const auto first = room.render(kStart, seed), second = later.render(kStart * motion, seed + 1000);
  return matcher.match(*matcher.prepare(room.pyramid(first)), later.pyramid(second));
}

TEST(DenseMatcher, FindsTheMotionByDepthsByBrightnessAndByBoth) {
  const RenderedRoom room;
  for (const int kinds : {1, 2, 3}) {
    DenseMatcherOptions options;
    options.use_depth = (kinds & 1) != 0;
    options.use_grey = (kinds & 2) != 0;
    const auto match = matched(room, room, options);
    EXPECT_TRUE(match.succeeded) << kinds;
    EXPECT_LT(offOf(match, kMotion).position, 0.002) << kinds;
    EXPECT_LT(offOf(match, kMotion).angle, 0.001) << kinds;
    EXPECT_GT(match.overlap, 0.8) << kinds;
    EXPECT_LT(match.outlier_share, 0.02) << kinds;
  }
}

TEST(DenseMatcher, AnImageOfTheSamePlaceHasNotMoved) {
  const RenderedRoom room;
  const auto match = matched(room, room, {}, Se3{});
  EXPECT_LT(offOf(match, Se3{}).position, 1e-4);
  EXPECT_GT(match.overlap, 0.99);
}

TEST(DenseMatcher, AChangeOfExposureIsNoMotion) {
  const RenderedRoom room;
  RenderedRoom brighter = room;
  brighter.gain = 1.25;
  brighter.offset = -15;
  DenseMatcherOptions options;
  options.use_depth = false;
  const auto match = matched(room, brighter, options);
  EXPECT_LT(offOf(match, kMotion).position, 0.003);
  EXPECT_LT(offOf(match, kMotion).angle, 0.0015);
}

// A bare wall leaves two shifts and a turn open, which stay as they were guessed. A pattern on the wall determines
// them.
TEST(DenseMatcher, ABareWallLeavesThreeDirectionsOpen) {
  RenderedRoom wall;
  wall.only_far_wall = true;
  const DenseMatcher matcher;
  const auto first = wall.render(Se3{}), second = wall.render(posed(0.02, 0.01, 0.03, 0, 0, 0.02));
  const auto bare = matcher.match(*matcher.prepare(wall.pyramid(first, false)), wall.pyramid(second, false));
  EXPECT_EQ(bare.open_directions, 3);
  EXPECT_FALSE(bare.succeeded);
  EXPECT_NEAR(bare.reference_from_image.translation.z(), 0.03, 1e-3) << "towards it, the motion is known";
  EXPECT_LT(bare.reference_from_image.translation.head<2>().norm(), 2e-3);
  EXPECT_GT(bare.covariance(0, 0), 100);
  const auto with_pattern = matcher.match(*matcher.prepare(wall.pyramid(first)), wall.pyramid(second));
  EXPECT_EQ(with_pattern.open_directions, 0);
  EXPECT_NEAR(with_pattern.reference_from_image.translation.x(), 0.02, 2e-3);
}

TEST(DenseMatcher, WhatIsGuessedHoldsWhereNothingElseDoes) {
  RenderedRoom wall;
  wall.only_far_wall = true;
  const DenseMatcher matcher;
  const auto image = wall.render(Se3{});
  DenseGuess guess{posed(0.1, 0, 0.01, 0, 0, 0), 1e4 * Matrix6d::Identity()};
  const auto match = matcher.match(*matcher.prepare(wall.pyramid(image, false)), wall.pyramid(image, false), guess);
  EXPECT_NEAR(match.reference_from_image.translation.x(), 0.1, 1e-3);
  EXPECT_NEAR(match.reference_from_image.translation.z(), 0, 1e-3);
}

// 2 rad/s and 0.3 m/s, as a hand moves: rows that are taken one after another distort the image.
TEST(DenseMatcher, ARollingShutterIsCorrectedIfTheMotionIsGiven) {
  const RenderedRoom room;
  CameraMotion motion;
  motion.velocity << 0.3, 0, 0.1, 0.3, 2, 0.5;
  motion.depth_readout = 0.03;
  motion.picture_readout = 0.02;
  motion.picture_delay = 0.01;
  const auto rowsOf = [&](const Se3& middle, double delay, double readout) {
    return [=](int row) {
      const double after = delay + readout * ((row + 0.5) / 240 - 0.5);
      return middle * geometry::plus(Se3{}, after * motion.velocity);
    };
  };
  const Se3 end = kStart * kMotion;
  const auto first = room.render(kStart);
  const auto second =
      room.render(rowsOf(end, 0, motion.depth_readout), rowsOf(end, motion.picture_delay, motion.picture_readout));
  const DenseMatcher matcher;
  const auto reference = matcher.prepare(room.pyramid(first));
  const auto with_motion = matcher.match(*reference, room.pyramid(second), {}, motion);
  EXPECT_LT(offOf(with_motion, kMotion).position, 0.004);
  EXPECT_LT(offOf(with_motion, kMotion).angle, 0.002);
  const auto without_motion = matcher.match(*reference, room.pyramid(second));
  EXPECT_GT(offOf(without_motion, kMotion).angle, 3 * offOf(with_motion, kMotion).angle);
  CameraMotion delay_unknown = motion;
  delay_unknown.picture_delay = 0;
  delay_unknown.delay_sigma = 0.02;
  const auto found = matcher.match(*reference, room.pyramid(second), {}, delay_unknown);
  EXPECT_NEAR(found.delay, 0.01, 0.0015);
  EXPECT_LT(found.delay_sigma, 0.002);
  // The distorted image can also be the reference.
  const auto back = matcher.match(*matcher.prepare(room.pyramid(second), motion), room.pyramid(first));
  EXPECT_LT(offOf(back, inverse(kMotion)).angle, 0.002);
}

// The squared error in standard deviations: 6 on average if the covariance is right.
TEST(DenseMatcher, ItsCovarianceIsOfTheErrorsSize) {
  RenderedRoom room;
  room.depth_noise = camera::DepthNoise().sigma;
  room.grey_noise = 4;
  double sum = 0;
  constexpr int runs = 10;
  for (int i = 0; i < runs; ++i) {
    const auto match = matched(room, room, {}, kMotion, static_cast<std::uint64_t>(i + 1));
    const Vector6d off = minus(match.reference_from_image, kMotion);
    sum += off.dot(match.covariance.ldlt().solve(off)) / runs;
  }
  RecordProperty("normalized_error", std::to_string(sum / 6));
  EXPECT_GT(sum / 6, 0.2);
  EXPECT_LT(sum / 6, 5);
}

TEST(DenseMatcher, WhatShowsSomethingElseFails) {
  const RenderedRoom room;
  EXPECT_FALSE(matched(room, room, {}, posed(0, 0, 0, 0, 2.5, 0)).succeeded) << "the wall behind";
  RenderedRoom smaller = room;
  for (double& half : smaller.half) half *= 0.5;
  EXPECT_FALSE(matched(room, smaller, {}, Se3{}).succeeded) << "everything is nearer";
}

TEST(DenseMatcher, NothingIsFoundInNothing) {
  const RenderedRoom room;
  const auto image = room.render(kStart);
  auto empty = image;
  for (float& depth : empty.depth) depth = 0;
  const DenseMatcher matcher;
  const auto reference = matcher.prepare(room.pyramid(image));
  EXPECT_FALSE(matcher.match(*matcher.prepare(room.pyramid(empty)), room.pyramid(image)).succeeded);
  const auto match = matcher.match(*reference, room.pyramid(empty, false));
  EXPECT_FALSE(match.succeeded);
  EXPECT_EQ(match.open_directions, 6);
  EXPECT_EQ(match.reference_from_image.translation.norm(), 0) << "it stays where it was guessed";
  auto spoiled = image;
  for (std::size_t i = 0; i < spoiled.depth.size(); i += 37) spoiled.depth[i] = std::nanf("");
  EXPECT_LT(matcher.match(*reference, room.pyramid(spoiled)).reference_from_image.translation.norm(), 1e-3);
}

// A camera that changes its resolution, and images of only a few pixels.
TEST(DenseMatcher, TakesImagesOfAnySize) {
  const RenderedRoom room;
  RenderedRoom smaller = room;
  smaller.width = 240;
  smaller.height = 180;
  smaller.camera = {195, 195, 119.5, 89.5};
  EXPECT_TRUE(matched(room, smaller, {}).succeeded);
  EXPECT_LT(offOf(matched(room, smaller, {}), kMotion).position, 0.004);
  const auto image = room.render(kStart);
  const DenseMatcher matcher;
  const auto reference = matcher.prepare(room.pyramid(image));
  for (const int size : {1, 2, 3, 8}) {
    RenderedRoom tiny = room;
    tiny.width = tiny.height = size;
    tiny.camera = {4, 4, 0.5 * size, 0.5 * size};
    const auto other = tiny.render(kStart);
    EXPECT_TRUE(matcher.match(*reference, tiny.pyramid(other)).reference_from_image.translation.allFinite()) << size;
    const auto as_reference = matcher.prepare(tiny.pyramid(other));
    EXPECT_TRUE(matcher.match(*as_reference, room.pyramid(image)).reference_from_image.translation.allFinite()) << size;
  }
}

TEST(DenseMatcher, RefusesOptionsThatMeanNothing) {
  DenseMatcherOptions options;
  options.max_points = 0;
  EXPECT_THROW(DenseMatcher{options}, base::Error);
  options = {};
  options.grey_noise = 0;
  EXPECT_THROW(DenseMatcher{options}, base::Error);
}

TEST(RgbdPyramid, KeepsAPlaneAndTheNearerSideOfADepthDiscontinuity) {
  std::vector<float> depth(80 * 60);
  const camera::Pinhole camera{60, 60, 39.5, 29.5};
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) depth[static_cast<std::size_t>(80 * y + x)] = x < 41 ? 1.0F : 2.0F;
  const RgbdPyramid pyramid({depth.data(), 80, 60, camera}, nullptr);
  ASSERT_EQ(pyramid.levels().size(), 2U) << "a third one would have fewer than 20 rows";
  const auto& half = pyramid.levels()[1];
  EXPECT_EQ(half.width, 40);
  EXPECT_EQ(half.inverse_depth[half.at(19, 10)], 1);
  EXPECT_EQ(half.inverse_depth[half.at(21, 10)], 0.5F);
  EXPECT_EQ(half.inverse_depth[half.at(20, 10)], 0) << "two pixels of a surface have another middle";
  EXPECT_EQ(half.camera.cx, 19.5);
  EXPECT_FALSE(pyramid.hasPicture());
}

TEST(RgbdPyramid, RefusesAPictureOfAnotherSize) {
  const std::vector<float> depth(80 * 60, 1);
  const std::vector<std::uint8_t> grey(40 * 30);
  const camera::ColourImage colour{grey.data(), 40, 30, 40, camera::ColourImage::Order::grey};
  EXPECT_THROW(RgbdPyramid({depth.data(), 80, 60, {}}, &colour), base::Error);
}

}  // namespace
}  // namespace omnimapper::matching::dense_matcher_test
