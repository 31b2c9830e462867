#include <gtest/gtest.h>
#include <omnimapper/derived/Closures.h>
#include <omnimapper/testing/HandMadeRun.h>

namespace omnimapper::derived::closures_test {
namespace {

// A search result that agrees with the estimate, a slip and a revoked verdict are also decisions about two key frames.
TEST(Closures, AreLoopClosuresAndNoOtherDecisionAboutTwoKeyFrames) {
  testing::HandMadeRun run;
  for (int i = 0; i < 4; ++i) run.addFrame({1.0 * i, 0, 0, 0, 0, 0});
  for (const std::string kind : {"loop closure", "global loop search", "slip", "loop closure, taken back"}) {
    mapper::Decision decision;
    decision.kind = kind;
    decision.is_loop_closure = kind == "loop closure";
    decision.from = run.map.key_frames[3].id;
    decision.to = run.map.key_frames[0].id;
    run.decisions.push_back(decision);
  }
  const auto closures = closuresOf(run.map, run.decisions);
  ASSERT_EQ(closures.size(), 1U);
  EXPECT_EQ(closures[0].decision->kind, "loop closure");
}

// Odometry, a hypothesis without weight and one between neighbours are no closed loops.
TEST(Closures, ClosedLoopsAreHypothesesWithWeightBetweenKeyFramesThatDoNotFollowOneAnother) {
  testing::HandMadeRun run;
  for (int i = 0; i < 4; ++i) run.addFrame({1.0 * i, 0.5, 0, 0, 0, 0});
  const auto tie = [&](int from, int to, double weight, bool is_hypothesis) {
    const auto& frames = run.map.key_frames;
    auto record = mapper::betweenPoses(run.motion, frames[from].pose, frames[to].pose,
                                       {{}, Eigen::Matrix<double, 6, 6>::Identity()}, "closer");
    record.weight = weight;
    record.tags.hypothesis = is_hypothesis;
    run.graph.addFactor(record);
  };
  tie(0, 1, 1, false);
  tie(0, 3, 0, true);
  tie(1, 2, 1, true);
  tie(0, 2, 1, false);
  tie(3, 0, 1, true);
  const auto closed = closedLoopsOf(run.view());
  ASSERT_EQ(closed.loops.size(), 1U);
  EXPECT_EQ(closed.loops[0].from, run.map.key_frames[3].id);
  EXPECT_EQ(closed.loops[0].to, run.map.key_frames[0].id);
  EXPECT_EQ(closed.loops[0].from_in_map, Eigen::Vector2d(3, 0.5));
  EXPECT_EQ(closed.loops[0].owner, "closer");
}

}  // namespace
}  // namespace omnimapper::derived::closures_test
