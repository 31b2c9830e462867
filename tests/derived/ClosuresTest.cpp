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

}  // namespace
}  // namespace omnimapper::derived::closures_test
