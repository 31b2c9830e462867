#include <gtest/gtest.h>
#include <omnimapper/matching/PointToLineMatcher.h>
#include <omnimapper/matching/Relocalizer.h>

#include <cmath>

#include "Beams.h"

namespace omnimapper::matching::relocalizer_test {
namespace {

using mrpt::math::TPose2D;
using testing::FloorPlan;
using Answer = Location::Answer;

constexpr double kDegree = 3.14159265358979323846 / 180;

Relocalizer mapOf(const FloorPlan& plan, const std::vector<TPose2D>& poses, double max_range = 8) {
  std::vector<MapScan> map;
  for (const auto& pose : poses) {
    for (const double turn : {0.0, 180.0}) {
      const TPose2D turned(pose.x, pose.y, pose.phi + turn * kDegree);
      map.push_back({turned, beamsFrom(plan, turned, 180, max_range, 0.01, map.size() + 1)});
    }
  }
  return Relocalizer(std::move(map), std::make_shared<PointToLineMatcher>(ScanMatcherOptions()));
}

std::vector<TPose2D> posesAroundTheRing() {
  std::vector<TPose2D> poses;
  for (double x = -8; x < 8.5; x += 1) {
    poses.emplace_back(x, 0, 0);
    poses.emplace_back(x, 9, 0);
  }
  for (double y = 1; y < 8.5; y += 1) {
    poses.emplace_back(-8.3, y, 90 * kDegree);
    poses.emplace_back(8.3, y, 90 * kDegree);
  }
  return poses;
}

void expectNear(const TPose2D& pose, const TPose2D& truth) {
  EXPECT_LT(std::hypot(pose.x - truth.x, pose.y - truth.y), 0.05) << pose << " is not " << truth;
  EXPECT_LT(std::abs(std::remainder(pose.phi - truth.phi, 360 * kDegree)), 1.0 * kDegree) << pose << " " << truth;
}

TEST(Relocalizer, FindsScansInTheRing) {
  const auto plan = FloorPlan::ring();
  const auto relocalizer = mapOf(plan, posesAroundTheRing());
  for (const TPose2D truth : {TPose2D(-5.2, 0.3, 0.4), TPose2D(8.6, 5.1, -2), TPose2D(2.2, 8.7, 3.1),
                              TPose2D(-8.1, 3.3, 80 * kDegree), TPose2D(0.4, -0.2, 170 * kDegree)}) {
    const auto location = relocalizer.locate(beamsFrom(plan, truth, 180, 8, 0.01, 99));
    ASSERT_EQ(location.answer, Answer::found) << truth;
    expectNear(location.candidates[0].map_from_sensor, truth);
    EXPECT_GT(location.candidates[0].probability, 0.95);
    EXPECT_GT(location.candidates[0].match.overlap, 0.9);
  }
}

TEST(Relocalizer, ASymmetricRoomIsAmbiguousAndBothPosesAreReturned) {
  FloorPlan room;
  room.addPolygon({{-3, -2}, {3, -2}, {3, 2}, {-3, 2}});
  const auto relocalizer = mapOf(room, {{0, 0, 0}, {1, 0.5, 0}, {-1, -0.5, 0}});
  const TPose2D truth(1.2, 0.4, 0.3), twin(-1.2, -0.4, 0.3 + 180 * kDegree);
  const auto location = relocalizer.locate(beamsFrom(room, truth, 180, 8, 0.01, 7));
  ASSERT_EQ(location.answer, Answer::ambiguous);
  ASSERT_GE(location.candidates.size(), 2u);
  const bool first_is_truth = location.candidates[0].map_from_sensor.x > 0;
  expectNear(location.candidates[first_is_truth ? 0 : 1].map_from_sensor, truth);
  expectNear(location.candidates[first_is_truth ? 1 : 0].map_from_sensor, twin);
}

// Two equal rooms; the lobbies before them differ in shape.
TEST(Relocalizer, AScanOfTheLobbyDistinguishesTwoEqualRooms) {
  FloorPlan plan;
  for (const double x : {0.0, 20.0}) {
    plan.addPolygon({{x, 0}, {x + 5, 0}, {x + 5, 4}, {x, 4}, {x, 2.6}, {x + 0.6, 2.2}, {x, 1.8}});
    plan.addPolygon({{x, -5}, {x + 5, -5}, {x + 5, -1}, {x + (x > 0 ? 3 : 4), -1}, {x + 2, -2}, {x, -2}});
  }
  const auto relocalizer = mapOf(
      plan,
      {{1.5, 1, 0}, {3.5, 3, 0}, {1.5, -4, 0}, {3.5, -3, 0}, {21.5, 1, 0}, {23.5, 3, 0}, {21.5, -4, 0}, {23.5, -3, 0}});
  const TPose2D in_room(22.5, 2.2, 0.4), in_lobby(23.2, -3.2, -0.2);
  const auto room = beamsFrom(plan, in_room, 360, 8, 0.01, 7), lobby = beamsFrom(plan, in_lobby, 360, 8, 0.01, 8);
  EXPECT_EQ(relocalizer.locate(room).answer, Answer::ambiguous);
  const auto location = relocalizer.locateTogether({{{}, room}, {in_lobby - in_room, lobby}});
  ASSERT_EQ(location.answer, Answer::found);
  expectNear(location.candidates[0].map_from_sensor, in_room);
}

TEST(Relocalizer, AWindowLeavesOneOfTwoAlikePlaces) {
  FloorPlan room;
  room.addPolygon({{-3, -2}, {3, -2}, {3, 2}, {-3, 2}});
  const auto relocalizer = mapOf(room, {{0, 0, 0}, {1, 0.5, 0}, {-1, -0.5, 0}});
  const TPose2D truth(1.2, 0.4, 0.3);
  const auto location =
      relocalizer.locate(beamsFrom(room, truth, 180, 8, 0.01, 7), SearchWindow{{1, 0, 0}, 1, 1, 60 * kDegree});
  ASSERT_EQ(location.answer, Answer::found);
  expectNear(location.candidates[0].map_from_sensor, truth);
}

// Two corridors of the same width and length, one closed at its end and one open: their walls are alike, their free
// space is not.
TEST(Relocalizer, BeamsWithoutEchoDistinguishAnOpenCorridorFromAClosedOne) {
  FloorPlan plan;
  plan.addPolygon({{0, 0}, {6, 0}, {6, 2}, {0, 2}});
  plan.walls.push_back({{0, 20}, {6, 20}});
  plan.walls.push_back({{0, 22}, {6, 22}});
  plan.walls.push_back({{0, 20}, {0, 22}});
  const auto relocalizer = mapOf(plan, {{1, 1, 0}, {3, 1, 0}, {5, 1, 0}, {1, 21, 0}, {3, 21, 0}, {5, 21, 0}}, 9);
  const TPose2D truth(2, 21, 0);
  auto scan = beamsFrom(plan, truth, 360, 9, 0.01, 5);
  ASSERT_GT(scan.misses.size(), 10u);
  const auto location = relocalizer.locate(scan);
  ASSERT_EQ(location.answer, Answer::found);
  expectNear(location.candidates[0].map_from_sensor, truth);
  scan.misses.clear();
  const auto blind = relocalizer.locate(scan);
  ASSERT_GE(blind.candidates.size(), 2u);
  EXPECT_GT(blind.candidates[1].log_likelihood, location.candidates[1].log_likelihood + 0.05);
}

TEST(Relocalizer, AScanOfAnotherBuildingIsNowhere) {
  const auto relocalizer = mapOf(FloorPlan::ring(), posesAroundTheRing());
  FloorPlan hall;
  hall.addPolygon({{-7, -5}, {1, -6}, {6, -1}, {5, 5}, {0, 3}, {-4, 6}});
  EXPECT_EQ(relocalizer.locate(beamsFrom(hall, {0, 0, 0}, 360, 12)).answer, Answer::none);
}

TEST(Relocalizer, WithoutPointsThereIsNoAnswer) {
  const auto plan = FloorPlan::box();
  const auto relocalizer = mapOf(plan, {{0, 0, 0}});
  EXPECT_EQ(relocalizer.locate({}).answer, Answer::none);
  EXPECT_TRUE(relocalizer.locate({}).candidates.empty());
  EXPECT_EQ(relocalizer.locate({{}, {{8, 0}, {0, 8}}}).answer, Answer::none) << "all beams met nothing";
  const auto matcher = std::make_shared<PointToLineMatcher>(ScanMatcherOptions());
  EXPECT_EQ(Relocalizer({}, matcher).locate(beamsFrom(plan, {0, 0, 0})).answer, Answer::none);
}

TEST(Relocalizer, APointOrTwoAreNoPlace) {
  const auto relocalizer = mapOf(FloorPlan::ring(), posesAroundTheRing());
  EXPECT_NE(relocalizer.locate({{{1, 0}, {1, 1}}, {}}).answer, Answer::found);
}

TEST(Relocalizer, PointsThatAreNotFiniteAreLeftOut) {
  const auto plan = FloorPlan::ring();
  const auto relocalizer = mapOf(plan, posesAroundTheRing());
  const TPose2D truth(8.6, 5.1, -2);
  auto scan = beamsFrom(plan, truth, 180, 8, 0.01, 99);
  scan.hits.emplace_back(NAN, 1);
  scan.misses.emplace_back(1, INFINITY);
  const auto location = relocalizer.locate(scan);
  ASSERT_EQ(location.answer, Answer::found);
  expectNear(location.candidates[0].map_from_sensor, truth);
}

}  // namespace
}  // namespace omnimapper::matching::relocalizer_test
