#include <gtest/gtest.h>
#include <omnimapper/matching/RecentViews.h>

#include <vector>

#include "Scans.h"

namespace omnimapper::matching::recent_views_test {
namespace {

using Eigen::Vector2f;
using mrpt::math::TPose2D;

// What a laser at the origin sees of a wall across its way.
ScanView viewOfWall(float ahead) {
  ScanWithNormals scan;
  for (int i = -40; i <= 40; ++i) scan.points.emplace_back(ahead, 0.05F * static_cast<float>(i));
  return {{}, Vector2f(0, 0), scan};
}

// Two views with a wall at 2 m, then three with one at 4 m, half a second apart.
RecentViews views() {
  RecentViews views;
  for (int i = 0; i < 5; ++i) views.add(viewOfWall(i < 2 ? 2 : 4), 0.5 * i);
  return views;
}

TEST(RecentViews, CountsWhatWasSeenOfAPlaceUntilATime) {
  const auto until = [](double seconds) { return views().at(Vector2f(2, 0), 0.1F, seconds); };
  EXPECT_EQ(until(0.6).occupied, 2);
  EXPECT_EQ(until(0.6).free, 0);
  EXPECT_TRUE(until(0.6).isOccupied());
  EXPECT_EQ(until(10).free, 3);
  EXPECT_FALSE(until(10).isFree()) << "three against two";
  EXPECT_FALSE(until(10).isOccupied());
  EXPECT_TRUE(views().at(Vector2f(3.5F, 0), 0.1F, 10).isFree()) << "hidden twice, then free three times";
}

TEST(RecentViews, OfAThingMostPointsMustBeFree) {
  const std::vector<Vector2f> before_wall{{1, -0.2F}, {1, 0}, {1, 0.2F}};
  EXPECT_EQ(views().at(before_wall, 0.1F, 10).free, 5);
  const std::vector<Vector2f> partly_in_it{{1, 0}, {2, 0.2F}, {2, 0.4F}};
  EXPECT_EQ(views().at(partly_in_it, 0.1F, 0.6).free, 0);
  EXPECT_EQ(views().at(partly_in_it, 0.1F, 0.6).occupied, 2);
}

TEST(RecentViews, ANarrowThingMayHaveBeenMissed) {
  const std::vector<Vector2f> narrow{{1, 0}, {1, 0.02F}};
  EXPECT_EQ(views().at(narrow, 0.1F, 10).free, 0);
}

TEST(RecentViews, AreForgottenAndThinned) {
  RecentViews views;
  for (int i = 0; i < 10; ++i) views.add(viewOfWall(4), 0.16 * i);
  EXPECT_EQ(views.at(Vector2f(2, 0), 0.1F, 100).free, 5) << "every second one";
  views.add(viewOfWall(4), 100);
  EXPECT_EQ(views.at(Vector2f(2, 0), 0.1F, 100).free, 1);
}

// The laser turns by 20 deg, but its pose says that it did not: walls stand where beams passed.
TEST(RecentViews, ContradictAWrongPose) {
  testing::FloorPlan plan;
  plan.addPolygon({{-3, -2}, {4, -2}, {4, 2}, {-3, 2}});
  RecentViews views;
  const auto scanAt = [&](const TPose2D& pose) {
    auto scan = scanFrom(plan, pose);
    scan.things.assign(scan.size(), ScanWithNormals::kNoThing);
    return scan;
  };
  EXPECT_FALSE(views.contradict({}, scanAt({}))) << "nothing was seen yet";
  for (int i = 0; i < 4; ++i) views.add(ScanView({}, Vector2f(0, 0), scanAt({})), 0.5 * i);
  const TPose2D turned(0, 0, 0.35);
  EXPECT_FALSE(views.contradict(turned, scanAt(turned)));
  EXPECT_TRUE(views.contradict({}, scanAt(turned)));
}

}  // namespace
}  // namespace omnimapper::matching::recent_views_test
