#include <gtest/gtest.h>
#include <omnimapper/testing/HandMadeRun.h>

#include "laser2d/SlipEvidence.h"
#include "laser2d/SlipSearch.h"

namespace omnimapper::plugins::slip_evidence_test {
namespace {

using Says = mapper::Evidence::Says;

// Drives 30 m along a line, jumps back, and drives it again with the same heading; one key frame each metre.
testing::HandMadeRun thereAgain() {
  testing::HandMadeRun run;
  for (int i = 0; i <= 30; ++i) run.addFrame({1.0 * i, 0, 0, 0, 0, 0});
  for (int i = 0; i <= 30; ++i) run.addFrame({1.0 * i, 0.5, 0, 0, 0, 0});
  return run;
}

mapper::Decision decisionAbout(const testing::HandMadeRun& run, const std::string& kind, std::size_t from,
                               std::size_t to, bool accepted) {
  mapper::Decision decision(run.map.key_frames[from], "loops", kind);
  decision.is_loop_closure = kind == "loop closure";
  decision.to = run.map.key_frames[to].id;
  decision.accepted = accepted;
  return decision;
}

TEST(SlipEvidence, ASlipThatWasUndoneIsReportedWithItsTimeAndSize) {
  auto run = thereAgain();
  EXPECT_TRUE(slips(run.view(), "loops", run.decisions).empty());
  auto decision = decisionAbout(run, kSlip, 20, 19, true);
  decision.numbers = {{kSlippedBy, 1.25}, {kSlippedByAngle, 14}};
  run.decisions.push_back(decision);
  const auto evidence = slips(run.view(), "loops", run.decisions);
  ASSERT_EQ(evidence.size(), 1U);
  EXPECT_EQ(evidence[0].says, Says::good);
  EXPECT_EQ(evidence[0].reason, "a slip of 1.2 m and 14 deg, 20 s after the start, was undone");
  EXPECT_TRUE(slips(run.view(), "others", run.decisions).empty());
}

TEST(SlipEvidence, ClosuresThatAgreeAndContradictItAreAgainstTheMapUntilOneActsAcross) {
  auto run = thereAgain();
  run.decisions = {decisionAbout(run, "loop closure", 30, 5, true), decisionAbout(run, kSlip, 40, 10, false),
                   decisionAbout(run, "loop closure", 50, 35, true)};
  const auto evidence = slips(run.view(), "loops", run.decisions);
  ASSERT_EQ(evidence.size(), 1U);
  EXPECT_EQ(evidence[0].says, Says::against_it);
  EXPECT_NE(evidence[0].reason.find("from 40 s after the start on"), std::string::npos) << evidence[0].reason;
  run.decisions.push_back(decisionAbout(run, "loop closure", 55, 8, true));
  EXPECT_TRUE(slips(run.view(), "loops", run.decisions).empty());
}

}  // namespace
}  // namespace omnimapper::plugins::slip_evidence_test
