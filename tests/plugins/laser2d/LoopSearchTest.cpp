// Each result of a search, in a world that leads to it. A key frame at (0, 0) saw the walls; another one, after 20 m of
// travel, is at (1, 0.2), with an error in its estimate.
#include <gtest/gtest.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/Between.h>
#include <omnimapper/matching/ScanMatcherOptions.h>
#include <omnimapper/testing/HandMadeRun.h>

#include "WallWorlds.h"
#include "laser2d/LoopSearch.h"

namespace omnimapper::plugins::loop_search_test {
namespace {

using mrpt::poses::CPose3D;
using testing::HandMadeRun;
using namespace wall_worlds;

class LoopSearchVerdict : public ::testing::Test {
 protected:
  /// How well the newest key frame's pose is known: within the convergence region of the fine matcher, or not at all.
  enum class Known { nearly, not_at_all };

  mapper::Decision search(const World& then, const World& now, Known known, double reach_now = 8) {
    const CPose3D truly(1, 0.2, 0, 0.1, 0, 0);
    const CPose3D estimated =
        truly + (known == Known::nearly ? CPose3D(0.1, 0.1, 0, 0.02, 0, 0) : CPose3D(1, 0.5, 0, 0.2, 0, 0));
    run_ = HandMadeRun();
    const auto place = run_.addFrame({}).id, newest = run_.addFrame(estimated).id;
    if (known == Known::nearly) {
      const auto sigmas = graph::SquareRootInformation::fromSigmas(Eigen::Vector3d(0.1, 0.1, 0.03));
      const auto measured = std::make_shared<graph::BetweenSe2>(geometry::project(geometry::fromMrpt(estimated)));
      run_.graph.addFactor(
          {{run_.map.keyFrame(place).pose, run_.map.keyFrame(newest).pose}, measured, sigmas, {}, 1, {}});
      run_.uncertainty = mapper::Uncertainty(run_.graph);
    }
    const LoopSearch::KeyScan first{place, scanFrom({}, then, 12), 0};
    mapper::PluginContext context;
    context.section = "loop_closure";
    const LoopSearch search(options_, context, matching::makeMatcher({}),
                            {{newest, scanFrom(truly, now, reach_now), 20}}, {{first, {first}}});
    batch_ = search(run_.view());
    if (batch_.decisions().empty()) return {};
    EXPECT_EQ(batch_.addedFactors().size(), batch_.decisions().front().accepted ? 1U : 0U);
    return batch_.decisions().front();
  }

  HandMadeRun run_;
  mapper::Batch batch_;
  LoopClosureOptions options_;
};

TEST_F(LoopSearchVerdict, AnUnevenRoomIsFoundFromNearAndFromFar) {
  auto world = room(6, 4);
  world.push_back({{1, 2}, {1, 0.8}});
  for (const auto known : {Known::nearly, Known::not_at_all}) {
    const auto decision = search(world, world, known);
    EXPECT_TRUE(decision.accepted) << decision.reason;
    EXPECT_EQ(decision.reason, "matched");
    ASSERT_EQ(batch_.addedFactors().size(), 1U);
    const auto& measured = dynamic_cast<const graph::BetweenSe2&>(*batch_.addedFactors().front().factor).measured();
    EXPECT_LT(minus(measured, geometry::Se2{1, 0.2, 0.1}).norm(), 0.02);
  }
}

TEST_F(LoopSearchVerdict, NoMatchWhereTheWallsDiffer) {
  const World posts{{{4, 4}, {4.5, 4.5}}, {{-5, 3}, {-5.4, 3.5}}, {{0, -6}, {0.5, -6}}, {{6, -1}, {6.3, -1.6}}};
  EXPECT_EQ(search(room(3, 3), posts, Known::not_at_all).reason, "no match in the search window");
}

TEST_F(LoopSearchVerdict, TooLittleOverlapWhereOneWallOfMoreIsTheSame) {
  const auto then = room(6, 4), now = World{then[0], {{-3, 3.5}, {3, 3.5}}, {{5, -2}, {5, 3.5}}};
  EXPECT_EQ(search(then, now, Known::nearly).reason, "too little overlap");
}

TEST_F(LoopSearchVerdict, AmbiguousWhereDoorsAlongACorridorAreAlike) {
  auto world = corridor();
  for (int i = -6; i <= 6; ++i) {
    world.push_back({{2.0 * i, 1.2}, {2.0 * i, 0.8}});
    world.push_back({{2.0 * i, -1.2}, {2.0 * i, -0.8}});
  }
  EXPECT_EQ(search(world, world, Known::not_at_all, 4).reason, "ambiguous: the scans fit elsewhere as well");
  EXPECT_TRUE(search(world, world, Known::nearly, 4).accepted) << "a known pose leaves no choice of doors";
}

TEST_F(LoopSearchVerdict, AmbiguousInASquareRoomWhereTheHeadingMayBeAny) {
  options_.max_window_angle = 3.2;
  EXPECT_EQ(search(room(5, 5), room(5, 5), Known::not_at_all).reason, "ambiguous: the scans fit elsewhere as well");
}

// A room, and 12 m away another one that differs by one wall: the robot is in the first.
TEST_F(LoopSearchVerdict, ARoomThatLooksLikeAnotherIsNoClosureIfTheOtherFitsBetter) {
  auto whole = room(6, 4);
  whole.push_back({{1, 2}, {1, 0.8}});
  const World lacking{whole[0], whole[2], whole[3]};
  const auto first = run_.addFrame({}).id, second = run_.addFrame({12, 0, 0, 0, 0, 0}).id;
  const auto newest = run_.addFrame({7, 0.5, 0, 0.2, 0, 0}).id;
  const auto bind = [&](base::KeyFrameId to, const geometry::Se2& where, const Eigen::Vector3d& sigmas) {
    run_.graph.addFactor({{run_.map.keyFrame(first).pose, run_.map.keyFrame(to).pose},
                          std::make_shared<graph::BetweenSe2>(where),
                          graph::SquareRootInformation::fromSigmas(sigmas)});
  };
  bind(second, {12, 0, 0}, {0.05, 0.05, 0.01});
  bind(newest, {7, 0.5, 0.2}, {4, 4, 0.2});
  run_.uncertainty = mapper::Uncertainty(run_.graph);
  const LoopSearch::KeyScan in_first{first, scanFrom({}, whole, 12), 0},
      in_second{second, scanFrom({}, lacking, 12), 12};
  const LoopSearch::KeyScan seen{newest, scanFrom({1, 0.2, 0, 0.1, 0, 0}, whole, 8), 40};
  mapper::PluginContext context;
  context.section = "loop_closure";
  const std::shared_ptr<const matching::ScanMatcher> matcher = matching::makeMatcher({});
  const auto alone = LoopSearch(options_, context, matcher, {seen}, {{in_second, {in_second}}})(run_.view());
  ASSERT_EQ(alone.decisions().size(), 1U);
  EXPECT_TRUE(alone.decisions()[0].accepted) << alone.decisions()[0].reason;
  const auto both =
      LoopSearch(options_, context, matcher, {seen}, {{in_second, {in_second}}, {in_first, {in_first}}})(run_.view());
  ASSERT_EQ(both.decisions().size(), 2U);
  EXPECT_EQ(both.decisions()[0].reason, "ambiguous: the scans fit another place as well or better");
  EXPECT_TRUE(both.decisions()[1].accepted) << both.decisions()[1].reason;
  EXPECT_EQ(both.addedFactors().size(), 1U);
}

TEST_F(LoopSearchVerdict, UnconstrainedAlongABareCorridor) {
  EXPECT_EQ(search(corridor(), corridor(), Known::nearly).reason, "the walls leave a direction unconstrained");
}

TEST_F(LoopSearchVerdict, TooWeakWhereTheWallsConstrainLessThanIsRequired) {
  const auto decision = search(room(6, 4), room(6, 4), Known::nearly);
  ASSERT_TRUE(decision.accepted) << decision.reason;
  ASSERT_EQ(decision.numbers.back().first, "uncertainty of the match [m]");
  options_.max_sigma = 0.9 * decision.numbers.back().second;
  EXPECT_EQ(search(room(6, 4), room(6, 4), Known::nearly).reason, "the walls constrain the match too weakly");
}

TEST_F(LoopSearchVerdict, NoSearchWhereAClosureWouldAddNoInformation) {
  options_.known_sigma = 0.2;
  options_.known_angle_sigma = 0.1;
  search(room(6, 4), room(6, 4), Known::nearly);
  EXPECT_TRUE(batch_.empty());
}

}  // namespace
}  // namespace omnimapper::plugins::loop_search_test
