#include <gtest/gtest.h>
#include <omnimapper/map/KeyFrame.h>
#include <omnimapper/plugin/DecisionLog.h>

namespace omnimapper::mapper::decision_log_test {
namespace {

Decision about(std::uint32_t from, std::uint32_t to, bool accepted, bool is_closure = true) {
  Decision decision;
  decision.from = {0, from};
  decision.to = base::KeyFrameId{0, to};
  decision.accepted = accepted;
  decision.is_loop_closure = is_closure;
  return decision;
}

TEST(Decision, AtAKeyFrameHasItsIdAndStampAndIsOpen) {
  map::KeyFrame frame;
  frame.id = {1, 7};
  frame.stamp = base::stampFromUnix(12);
  const Decision decision(frame, "walls", "plane");
  EXPECT_EQ(decision.from, frame.id);
  EXPECT_EQ(decision.stamp, frame.stamp);
  EXPECT_EQ(decision.plugin, "walls");
  EXPECT_EQ(decision.kind, "plane");
  EXPECT_FALSE(decision.accepted);
}

TEST(CountClosures, APairCountsOnceAndIsAcceptedIfAnyDecisionIs) {
  const DecisionLog decisions{about(10, 1, false), about(11, 1, true),  about(10, 1, true),
                              about(12, 2, false), about(12, 2, false), about(13, 3, true, false)};
  const auto counts = countClosures(decisions);
  EXPECT_EQ(counts.accepted, 2U);
  EXPECT_EQ(counts.refused, 1U);
  EXPECT_EQ(countClosures({}).accepted, 0U);
}

}  // namespace
}  // namespace omnimapper::mapper::decision_log_test
