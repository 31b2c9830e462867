#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>
#include <sstream>

#include "omnimapper/eval/ViewAgreement.h"

namespace omnimapper::eval::view_agreement_test {

namespace {

using surfaces::Surface;
using surfaces::SurfaceSet;
using Pair = std::pair<std::size_t, std::size_t>;

// Level, 1 m deep, from x = `from` to x = `to` at that height [m].
Surface top(double from, double to, double z = 0.75) {
  Surface surface;
  surface.name = "top from " + std::to_string(from);
  surface.plane = {Eigen::Vector3d::UnitZ(), -z};
  surface.parts.push_back({{{from, 0, z}, {to, 0, z}, {to, 1, z}, {from, 1, z}}, {}});
  return surface;
}

SurfaceSet mapOf(std::vector<Surface> all) {
  return {"test", std::move(all), {}};
}

// With a point in the middle of each plane, that much above it.
View view(const std::string& name, const std::vector<Surface>& planes, double error = 0) {
  View view{name, {}};
  for (const auto& plane : planes) {
    const auto& outline = plane.parts.front().outline;
    const Eigen::Vector3d middle = (outline[0] + outline[2]) / 2;
    view.planes.push_back({plane, {middle + error * Eigen::Vector3d::UnitZ()}});
  }
  return view;
}

// One table, seen as one by two views.
std::vector<View> twoViews() {
  return {view("first", {top(0, 2)}), view("second", {top(0.2, 2)})};
}

}  // namespace

TEST(ViewAgreement, AMapThatHasASurfaceOnceAgreesWithTheViewsOfIt) {
  const auto agreement = judgeByViews(mapOf({top(0, 2)}), twoViews());
  EXPECT_EQ(agreement.views, 2U);
  EXPECT_EQ(agreement.planes, 2U);
  EXPECT_TRUE(agreement.split.empty());
  EXPECT_TRUE(agreement.split_of_one.empty());
  EXPECT_TRUE(agreement.doubles.empty());
  ASSERT_EQ(agreement.seen.size(), 1U) << "both views show one surface";
  EXPECT_NEAR(agreement.area.seen, 2, 1e-9);
  EXPECT_NEAR(agreement.area.covered, 2, 1e-9);
  EXPECT_NEAR(agreement.area_twice.seen, 1.8, 1e-9);
}

TEST(ViewAgreement, ATableInTwoPiecesIsSplitWhereTwoViewsShowItAsOne) {
  const auto map = mapOf({top(0, 1), top(1, 2)});
  const auto agreement = judgeByViews(map, twoViews());
  ASSERT_EQ(agreement.split.size(), 1U);
  EXPECT_EQ(agreement.split.front().surfaces, Pair(0, 1));
  EXPECT_EQ(agreement.split.front().view, "first");
  EXPECT_EQ(agreement.split.front().other_view, "second");
  EXPECT_TRUE(agreement.doubles.empty());
  ASSERT_FALSE(agreement.levels.empty());
  EXPECT_EQ(agreement.levels.front().of_map.size(), 2U);
}

TEST(ViewAgreement, WhatASingleViewShowsAsOneIsCountedSeparately) {
  const auto map = mapOf({top(0, 1), top(1, 2)});
  const auto agreement = judgeByViews(map, {view("first", {top(0, 2)}), view("second", {top(0, 1), top(1, 2)})});
  EXPECT_TRUE(agreement.split.empty());
  ASSERT_EQ(agreement.split_of_one.size(), 1U);
  EXPECT_EQ(agreement.split_of_one.front().view, "first");
}

TEST(ViewAgreement, TwoTablesThatNoViewShowsAsOneAreTwo) {
  const auto views = {view("first", {top(0, 1), top(1.2, 2)}), view("second", {top(0, 1), top(1.2, 2)})};
  const auto agreement = judgeByViews(mapOf({top(0, 1), top(1.2, 2)}), views);
  EXPECT_TRUE(agreement.split.empty());
  EXPECT_TRUE(agreement.split_of_one.empty());
  EXPECT_EQ(agreement.seen.size(), 2U);
}

TEST(ViewAgreement, OfSmallSurfacesNoneIsSplit) {
  // 0.25 m^2 each; and one of less than a fifth.
  const auto small =
      judgeByViews(mapOf({top(0, 0.25), top(0.25, 0.5)}), {view("a", {top(0, 0.5)}), view("b", {top(0, 0.5)})});
  EXPECT_TRUE(small.split.empty());
  const auto edge = judgeByViews(mapOf({top(0, 1.65), top(1.65, 2)}), {view("a", {top(0, 2)}), view("b", {top(0, 2)})});
  EXPECT_TRUE(edge.split.empty());
}

TEST(ViewAgreement, ADoubledSurfaceIsAPairWithoutAnyView) {
  const auto agreement = judgeByViews(mapOf({top(0, 2), top(0, 2, 0.8), top(0, 2, 0.95)}), {});
  EXPECT_EQ(agreement.doubles, std::vector<Pair>({{0, 1}}));
  EXPECT_EQ(agreement.views, 0U);
  EXPECT_TRUE(agreement.levels.empty());
  EXPECT_FALSE(table(agreement).empty());
}

TEST(ViewAgreement, BothSidesOfABoardAreNoDouble) {
  Surface under = top(0, 2);
  under.plane = {-under.plane.normal, -under.plane.distance};
  EXPECT_TRUE(judgeByViews(mapOf({top(0, 2), under}), {}).doubles.empty());
}

TEST(ViewAgreement, OfAnEmptyMapNothingIsThere) {
  const auto agreement = judgeByViews(mapOf({}), twoViews());
  EXPECT_NEAR(agreement.area.seen, 2, 1e-9);
  EXPECT_EQ(agreement.area.covered, 0);
  EXPECT_EQ(agreement.points, 2U);
  EXPECT_EQ(agreement.distance.count, 0U);
  EXPECT_NEAR(agreement.seen.front().missing.area(), 1.8, 1e-9);
  ASSERT_FALSE(agreement.levels.empty());
  EXPECT_TRUE(agreement.levels.front().of_map.empty());
}

TEST(ViewAgreement, CandidatesOfTheMapDoNotCount) {
  Surface candidate = top(0, 2);
  candidate.is_candidate = true;
  const auto agreement = judgeByViews(mapOf({candidate}), twoViews());
  EXPECT_EQ(agreement.drawn, 0U);
  EXPECT_EQ(agreement.area.covered, 0);
}

TEST(ViewAgreement, ThePiecesOfTheLargestLevelSurfaceAreCounted) {
  const std::vector<View> views{view("a", {top(0, 3)}), view("b", {top(0, 1), top(1, 3)}), view("c", {top(0, 0.5, 2)})};
  const auto agreement = judgeByViews(mapOf({top(1, 3), top(0, 0.5), top(0.5, 1)}), views);
  ASSERT_FALSE(agreement.levels.empty());
  EXPECT_NEAR(agreement.levels.front().area, 3, 1e-9);
  EXPECT_EQ(agreement.levels.front().of_map.size(), 3U);
  EXPECT_EQ(agreement.levels.front().of_map.front(), 0U);
  EXPECT_NEAR(agreement.levels.front().height, 0.75, 1e-9);
  ASSERT_EQ(agreement.levels.size(), 2U) << "the other one is 2 m high";
  EXPECT_NEAR(agreement.levels.back().height, 2, 1e-9);
  EXPECT_TRUE(agreement.levels.back().of_map.empty());
  EXPECT_EQ(agreement.levels.front().in_views, std::vector<std::size_t>({2, 1}));
}

TEST(ViewAgreement, PointsAreAsFarAsTheNearestSurfaceThere) {
  const auto agreement = judgeByViews(mapOf({top(0, 2), top(0, 2, 0.69)}), {view("a", {top(0, 2)}, 0.02)});
  EXPECT_EQ(agreement.distance.count, 1U);
  EXPECT_NEAR(agreement.distance.median, 0.02, 1e-9);
  EXPECT_NEAR(agreement.distance_95, 0.02, 1e-9);
  const auto far = judgeByViews(mapOf({top(0, 2)}), {view("a", {top(0, 2)}, 0.2)});
  EXPECT_EQ(far.points, 1U);
  EXPECT_EQ(far.distance.count, 0U);
}

TEST(ViewAgreement, AChainOfPlanesDoesNotClimb) {
  // Each is within 0.1 m of the one before, the last 0.24 m above the first.
  const std::vector<View> views{view("a", {top(0, 2)}), view("b", {top(0, 1.9, 0.83)}), view("c", {top(0, 1.8, 0.91)}),
                                view("d", {top(0, 1.7, 0.99)})};
  EXPECT_EQ(judgeByViews(mapOf({}), views).seen.size(), 2U);
}

TEST(ViewAgreement, OnlyWhatCountsOfAPlaneIsJudged) {
  View seen = view("a", {top(0, 2)});
  auto& surface = seen.planes.front().surface;
  surface.seen = surfaces::CellGrid::around(surface.plane, cornersOf(surface), 0.05);
  surface.seen->fill(top(0, 0.5).parts.front().outline);
  EXPECT_NEAR(judgeByViews(mapOf({}), {seen}).area.seen, 0.5, 1e-9);
}

TEST(ViewAgreement, TheReportNamesWhatIsWrong) {
  const testing::ScratchFolder scratch;
  const auto map = mapOf({top(0, 1), top(1, 2), top(5, 6), top(5, 6, 0.8)});
  const auto agreement = judgeByViews(map, {view("a", {top(0, 2), top(8, 9)}), view("b", {top(0, 2), top(8, 9)})});
  saveReport(scratch / "views", "test", agreement, map);
  EXPECT_NE(json(agreement, map).find("\"split_pairs\": 1"), std::string::npos);
  EXPECT_NE(json(agreement, map).find("\"doubled_pairs\": 1"), std::string::npos);
  EXPECT_NE(table(agreement).find("one in two views"), std::string::npos);
  std::ostringstream text;
  text << std::ifstream(scratch / "views/plan.svg").rdbuf();
  const std::string plan = text.str();
  // In the legend and drawn.
  for (const char* colour : {"#dc2626", "#2563eb", "#525252"}) {
    const auto first = plan.find(colour);
    ASSERT_NE(first, std::string::npos) << colour;
    EXPECT_NE(plan.find(colour, first + 1), std::string::npos) << colour;
  }
}

TEST(ViewAgreement, ASurfaceThatReachesTooFarIsRefusedByName) {
  EXPECT_THROW(judgeByViews(mapOf({top(0, 1e7)}), {}), base::Error);
}

}  // namespace omnimapper::eval::view_agreement_test
