#include <gtest/gtest.h>
#include <omnimapper/matching/MovingThings.h>
#include <omnimapper/matching/Things.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "Scans.h"

namespace omnimapper::matching::moving_things_test {
namespace {

using Eigen::Vector2d;
using mrpt::math::TPose2D;
using testing::FloorPlan;

const Eigen::Vector2f kLaser(0, 0);

void addPost(FloorPlan& plan, const Vector2d& place, double side = 0.25) {
  const double h = 0.5 * side;
  plan.addPolygon({place + Vector2d(-h, -h), place + Vector2d(h, -h), place + Vector2d(h, h), place + Vector2d(-h, h)});
}

struct Followed {
  std::size_t recognized = 0;  // things
  double first = NAN;          // [s]
  // Points that are farther than 0.3 m from the post, and nearer; and those of them that are said to move.
  std::size_t others = 0, moving_others = 0, of_post = 0, moving_of_post = 0;
};

// Follows a post in a hall of 12 x 6 m for 8 s at 10 Hz.
Followed follow(const std::function<TPose2D(double)>& laser, const std::function<Vector2d(double)>& post,
                const std::function<TPose2D(double)>& believed) {
  MovingThings things;
  Followed result;
  for (int i = 0; i < 80; ++i) {
    const double seconds = 0.1 * i;
    FloorPlan plan;
    plan.addPolygon({{-6, -3}, {6, -3}, {6, 3}, {-6, 3}});
    addPost(plan, {-2, 1.5}, 0.3);  // one that stands
    addPost(plan, post(seconds));
    auto scan = scanFrom(plan, laser(seconds), 0.01, static_cast<std::uint64_t>(i) + 1, 20);
    scan.things = numberThings(scan.points, kLaser, rangeNoise(scan.points));
    const auto recognized = things.add(believed(seconds), kLaser, seconds, scan);
    if (!recognized.empty() && std::isnan(result.first)) result.first = seconds;
    result.recognized += recognized.size();
    if (recognized.empty() && std::isnan(result.first)) continue;
    const auto& moves = things.moving();
    const ToTrack toTrack(laser(seconds));
    for (std::size_t k = 0; k < scan.size(); ++k) {
      const bool is_post = (toTrack(scan.points[k]) - post(seconds).cast<float>()).norm() < 0.3F;
      ++(is_post ? result.of_post : result.others);
      (is_post ? result.moving_of_post : result.moving_others) += moves[k];
    }
  }
  return result;
}

const auto kDrives = [](double t) { return TPose2D(-5 + 0.5 * t, 0, 0); };

TEST(MovingThings, OneThatLeadsIsRecognizedWithinTwoSeconds) {
  const auto result = follow(
      kDrives, [](double t) { return Vector2d(-4 + 0.5 * t, 0); }, kDrives);
  EXPECT_EQ(result.recognized, 1U);
  EXPECT_LT(result.first, 2);
  EXPECT_EQ(result.moving_others, 0U);
  EXPECT_GT(result.others, 0U);
}

// It passes the post that stands at 0.35 m, so that both are one thing for a while.
TEST(MovingThings, OneThatPassesAnotherLeavesItStanding) {
  const auto result = follow(
      kDrives, [](double t) { return Vector2d(-4.5 + 0.6 * t, 1.15); }, kDrives);
  EXPECT_LT(result.first, 3);
  EXPECT_GT(result.moving_of_post, result.of_post * 3 / 4);
  EXPECT_LT(result.moving_others, result.others / 200);
}

// It walks so near to the wall that most scans show no gap between them.
TEST(MovingThings, OneThatWalksAlongAWallIsTakenOutOfIt) {
  const auto result = follow(
      kDrives, [](double t) { return Vector2d(-3.5 + 0.6 * t, -2.6); }, kDrives);
  EXPECT_GE(result.recognized, 1U);
  EXPECT_GT(result.moving_of_post, result.of_post / 2);
  EXPECT_LT(result.moving_others, result.others / 200);
}

TEST(MovingThings, OneThatCrossesAndOneThatComesAreRecognized) {
  EXPECT_EQ(follow(
                kDrives, [](double t) { return Vector2d(2, -2 + 0.6 * t); }, kDrives)
                .recognized,
            1U);
  EXPECT_EQ(follow(
                kDrives, [](double t) { return Vector2d(4 - 0.5 * t, 0.8); }, kDrives)
                .recognized,
            1U);
}

TEST(MovingThings, WhatStandsIsNeverSaidToMove) {
  EXPECT_EQ(follow(
                kDrives, [](double) { return Vector2d(1, -1); }, kDrives)
                .recognized,
            0U);
  const auto turns = [](double t) { return TPose2D(0, 0, 0.5 * t); };
  EXPECT_EQ(follow(
                turns, [](double) { return Vector2d(2, -1); }, turns)
                .recognized,
            0U);
}

// The estimate stands still while the base moves on: walls would have to move, and so nothing is said to.
TEST(MovingThings, AWrongPoseMakesNothingMove) {
  const auto stuck = [](double t) { return t < 3 ? kDrives(t) : kDrives(3); };
  EXPECT_EQ(follow(
                kDrives, [](double) { return Vector2d(4, -1); }, stuck)
                .recognized,
            0U);
}

TEST(MovingThings, NothingIsKnownOfAnEmptyScan) {
  MovingThings things;
  ScanWithNormals empty;
  EXPECT_TRUE(things.add({}, kLaser, 0, empty).empty());
  const auto expected = things.expected({}, 0.1, empty);
  EXPECT_TRUE(expected.moves.empty());
  EXPECT_TRUE(expected.weights.empty());
}

// A thing that was not seen to stand counts far less than a wall; once the laser has moved on, it counts as one point.
TEST(MovingThings, AThingCountsOnceItWasSeenToStand) {
  MovingThings things;
  float before = NAN, after = NAN;
  for (int i = 0; i < 40; ++i) {
    const double seconds = 0.1 * i;
    FloorPlan plan;
    plan.addPolygon({{-6, -3}, {6, -3}, {6, 3}, {-6, 3}});
    addPost(plan, {0, 1});
    auto scan = scanFrom(plan, kDrives(seconds), 0.01, static_cast<std::uint64_t>(i) + 1, 20);
    scan.things = numberThings(scan.points, kLaser, rangeNoise(scan.points));
    const auto weights = things.expected(kDrives(seconds), seconds, scan).weights;
    float total = 0;
    for (std::size_t k = 0; k < scan.size(); ++k) {
      if (scan.things[k] != ScanWithNormals::kNoThing) total += weights[k];
    }
    (i == 1 ? before : after) = total;
    things.add(kDrives(seconds), kLaser, seconds, scan);
  }
  EXPECT_GT(before, 0);
  EXPECT_LT(before, 0.05F);
  EXPECT_NEAR(after, 1, 0.01);
}

}  // namespace
}  // namespace omnimapper::matching::moving_things_test
