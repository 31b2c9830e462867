// What a run that continues a map makes of the loop closures that people forbade.
#include <gtest/gtest.h>
#include <omnimapper/map/Corrections.h>
#include <omnimapper/plane_factors/WallFactor.h>
#include <omnimapper/testing/HandMadeRun.h>

#include "sessions/removeForbidden.h"

namespace omnimapper::mapper::forbidden_loops_test {
namespace {

using mrpt::poses::CPose3D;

/// Four key frames on a line, 1 m apart by odometry, and a loop closure that says that the last is 1 m from the first.
class ForbiddenLoopsTest : public ::testing::Test {
 protected:
  ForbiddenLoopsTest() {
    for (int i = 0; i < 4; ++i) made_.addFrame({1.0 * i, 0, 0, 0, 0, 0});
    for (int i = 1; i < 4; ++i) steps_.push_back(made_.graph.addFactor(between(i - 1, i)));
    auto loop = between(0, 3);
    loop.tags.hypothesis = true;
    factor_ = made_.graph.addFactor(loop);
    graph::solve(made_.graph);
    for (std::size_t i = 0; i < 4; ++i) {
      auto& frame = made_.map.key_frames.edit(made_.map.key_frames[i].id);
      frame.map_from_base = poseOf(made_.graph, frame.pose);
    }
  }
  graph::FactorRecord between(int from, int to) {
    const RelativeMotion one_metre{CPose3D(1, 0, 0, 0, 0, 0), 0.01 * Eigen::Matrix<double, 6, 6>::Identity()};
    const auto& frames = made_.map.key_frames;
    return betweenPoses(Motion::planar, frames[from].pose, frames[to].pose, one_metre, "odometry");
  }
  derived::SavedMap saved(std::vector<map::Corrections::ForbiddenLoop> forbidden) const {
    derived::SavedMap saved{made_.map, made_.graph};
    map::Corrections corrections;
    corrections.forbidden = std::move(forbidden);
    saved.map.layers.set(std::move(corrections));
    return saved;
  }
  map::Corrections::ForbiddenLoop loop(int from, int to) const {
    return {made_.map.key_frames[from].id, made_.map.key_frames[to].id, "", {}};
  }
  /// The first and the last key frame see a wall where they are.
  void seeWall(const geometry::Segment2& wall) {
    const auto id = made_.graph.addVariable(plane_factors::wallVariable(), plane_factors::toValue(wall));
    for (const auto* frame : {&made_.map.key_frames.front(), &made_.map.key_frames.back()}) {
      const Eigen::Vector2d seen = middle(wall) - Eigen::Vector2d(frame->map_from_base.x(), frame->map_from_base.y());
      made_.graph.addFactor({{frame->pose, id},
                             std::make_shared<plane_factors::WallFactor>(direction(wall), seen),
                             graph::SquareRootInformation::fromSigmas(Eigen::Vector2d(0.01, 0.02))});
    }
  }
  static double end(const derived::SavedMap& saved) { return saved.map.key_frames.back().map_from_base.x(); }

  testing::HandMadeRun made_;
  std::vector<base::FactorId> steps_;
  base::FactorId factor_;
};

TEST_F(ForbiddenLoopsTest, IsRemovedAndTheMapIsSolvedWithoutIt) {
  auto map = saved({loop(0, 3)});
  // Three metres by odometry, of variance 3, and one metre by the loop, of variance 1: (3 / 3 + 1 / 1) / (1 / 3 + 1).
  EXPECT_NEAR(end(map), 1.5, 1e-6);
  const auto found = removeForbidden(map, {});
  EXPECT_EQ(found.removed.size(), 1U);
  EXPECT_TRUE(found.kept.empty());
  EXPECT_FALSE(map.graph.contains(factor_));
  EXPECT_NEAR(end(map), 3, 1e-6);
  EXPECT_TRUE(removeForbidden(map, {}).removed.empty()) << "a later session finds nothing to remove";
}

TEST_F(ForbiddenLoopsTest, OdometryIsNoLoopAndOtherMapsStay) {
  auto odometry = saved({loop(1, 2)});
  EXPECT_TRUE(removeForbidden(odometry, {}).removed.empty());
  auto none = saved({});
  EXPECT_TRUE(removeForbidden(none, {}).removed.empty());
  EXPECT_NEAR(end(none), 1.5, 1e-6);
}

TEST_F(ForbiddenLoopsTest, TheOnlyTieOfTwoPartsOfTheMapIsKept) {
  made_.graph.removeFactor(steps_.back());
  auto map = saved({loop(0, 3)});
  const auto found = removeForbidden(map, {});
  EXPECT_TRUE(found.removed.empty());
  ASSERT_EQ(found.kept.size(), 1U);
  EXPECT_NE(found.kept[0].find("0:0 and 0:3"), std::string::npos) << found.kept[0];
  EXPECT_TRUE(map.graph.contains(factor_));
}

// A wall along the path says nothing about how far along it the last key frame is.
TEST_F(ForbiddenLoopsTest, ATieByOneWallIsTooLittleToRemoveTheLoop) {
  made_.graph.removeFactor(steps_.back());
  seeWall({{5, 2}, {0, 2}});
  auto map = saved({loop(0, 3)});
  EXPECT_EQ(removeForbidden(map, {}).kept.size(), 1U);
  EXPECT_TRUE(map.graph.contains(factor_));
  seeWall({{5, 0}, {5, 4}});  // across the path
  auto held = saved({loop(0, 3)});
  EXPECT_EQ(removeForbidden(held, {}).removed.size(), 1U);
  EXPECT_FALSE(held.graph.contains(factor_));
}

}  // namespace
}  // namespace omnimapper::mapper::forbidden_loops_test
