#include <gtest/gtest.h>
#include <omnimapper/graph/Prior.h>

#include "Dots.h"

namespace omnimapper::landmarks::landmark_associator_test {
namespace {

using Eigen::Vector2d;

double numberOf(const mapper::Decision& decision, const std::string& name) {
  for (const auto& [each, value] : decision.numbers)
    if (each == name) return value;
  return NAN;
}

TEST(LandmarkAssociator, WhatFitsNothingIsNew) {
  DotRun run;
  const auto decisions = run.see({{{1, 2}}}, 3);
  ASSERT_EQ(decisions.size(), 1U);
  EXPECT_TRUE(decisions[0].accepted);
  EXPECT_EQ(decisions[0].reason, "new: none is near");
  EXPECT_EQ(decisions[0].plugin, "dots");
  ASSERT_EQ(run.map.landmarks.size(), 1U);
  EXPECT_EQ(run.landmark(0).kind, "dot");
  EXPECT_EQ(run.landmark(0).evidence, 1U);
  EXPECT_EQ(run.graph.value(run.landmark(0).variables.front()), Vector2d(4, 2));
  const auto factors = run.view().factorsOf(run.landmark(0).id);
  ASSERT_EQ(factors.size(), 1U);
  EXPECT_EQ(run.graph.factor(factors[0]).tags.owner, "dots");
  EXPECT_EQ(run.graph.factor(factors[0]).tags.landmark, run.landmark(0).id);
}

TEST(LandmarkAssociator, AKnownLandmarkGetsAFactorEvidenceAndAPayload) {
  DotRun run;
  run.see({{{1, 2}}});
  const auto decisions = run.see({{{1.2, 2}}});
  ASSERT_EQ(decisions.size(), 1U);
  EXPECT_TRUE(decisions[0].accepted);
  EXPECT_EQ(decisions[0].reason, "matched");
  // 0.2 m, between two measurements of 0.1 m each: 0.04 / 0.02.
  EXPECT_NEAR(numberOf(decisions[0], "chi-square"), 2, 1e-9);
  EXPECT_EQ(numberOf(decisions[0], "landmark"), 0);
  EXPECT_EQ(run.map.landmarks.size(), 1U);
  EXPECT_EQ(run.landmark(0).evidence, 2U);
  EXPECT_EQ(run.measurementsOf(0), 2);
  EXPECT_EQ(run.view().factorsOf(run.landmark(0).id).size(), 2U);
}

TEST(LandmarkAssociator, WhatIsOutsideOfTheGateIsAnotherLandmark) {
  DotRun run;
  run.see({{{1, 2}}});
  // The gate of 99.9 % is at 13.8: 0.52 m and 0.53 m, with a variance of 0.02 m^2.
  EXPECT_EQ(run.see({{{1.52, 2}}})[0].reason, "matched");
  DotRun other;
  other.see({{{1, 2}}});
  EXPECT_EQ(other.see({{{1.53, 2}}})[0].reason, "new: gated out: too far from the nearest");
  EXPECT_EQ(other.map.landmarks.size(), 2U);
}

TEST(LandmarkAssociator, WhatFitsTwoIsLeftOutUnlessItMayBeOfEither) {
  for (const bool are_pairs_one : {false, true}) {
    DotOptions options;
    options.are_pairs_one = are_pairs_one;
    DotRun run(options);
    run.see({{{1, 2}}, {{1.3, 2}}});
    const auto decisions = run.see({{{1.16, 2}}});
    EXPECT_EQ(decisions[0].accepted, are_pairs_one);
    EXPECT_EQ(decisions[0].reason,
              are_pairs_one ? "matched: they are a pair" : "fits two landmarks about equally well");
    EXPECT_EQ(run.landmark(0).evidence, 1U);
    EXPECT_EQ(run.landmark(1).evidence, are_pairs_one ? 2U : 1U) << "the likelier one";
    EXPECT_EQ(run.map.landmarks.size(), 2U);
  }
}

TEST(LandmarkAssociator, ALandmarkThatIsSeenTwiceAtOnceHasBothMeasurements) {
  for (const auto repeats : {mapper::Repeats::no, mapper::Repeats::yes}) {
    DotOptions options;
    options.repeats = repeats;
    DotRun run(options);
    run.see({{{1, 2}}});
    run.see({{{1, 2}}, {{1.02, 2}}});
    const bool both = repeats == mapper::Repeats::yes;
    EXPECT_EQ(run.landmark(0).evidence, both ? 3U : 2U);
    EXPECT_EQ(run.measurementsOf(0), both ? 3 : 2) << "the second payload continues from the first";
    EXPECT_EQ(run.map.landmarks.size(), both ? 1U : 2U);
  }
}

// The pose is wrong by 0.9 m: by itself, each dot is nearest to a wrong one.
TEST(LandmarkAssociator, MeasurementsAreAssociatedJointly) {
  const std::vector<Dot> dots = {{{0, 2}}, {{1, 2}}, {{2.5, 2}}, {{4.5, 2}}};
  DotRun run;
  run.see(dots);
  const auto frame = run.addFrame({0.9, 0, 0, 0, 0, 0});
  run.graph.addFactor({{frame.pose},
                       std::make_shared<graph::PriorSe2>(geometry::Se2{0.9, 0, 0}),
                       graph::SquareRootInformation::fromSigmas(Eigen::Vector3d(0.6, 0.6, 1e-4))});
  for (const auto& decision : run.seeFrom(frame, dots)) EXPECT_EQ(decision.reason, "matched");
  for (std::uint32_t i = 0; i < dots.size(); ++i) EXPECT_EQ(run.landmark(i).evidence, 2U) << i;
  EXPECT_EQ(run.map.landmarks.size(), dots.size());
}

TEST(LandmarkAssociator, InAHeldMapNothingIsNew) {
  DotRun run;
  run.see({{{1, 2}}});
  run.map_is_held = true;
  const auto decisions = run.see({{{1, 2}}, {{4, 2}}});
  EXPECT_EQ(decisions[0].reason, "matched");
  EXPECT_FALSE(decisions[1].accepted);
  EXPECT_EQ(decisions[1].reason, "not in the map: gated out: too far from the nearest");
  EXPECT_EQ(run.map.landmarks.size(), 1U);
}

TEST(LandmarkAssociator, AUselessMeasurementIsLoggedWithItsReason) {
  DotRun run;
  const auto decisions = run.see({{{1, 2}}, {{5, 2}, -1, true}});
  ASSERT_EQ(decisions.size(), 2U);
  EXPECT_EQ(decisions[0].reason, "blurred");
  EXPECT_EQ(numberOf(decisions[0], "x [m]"), 5);
  EXPECT_FALSE(decisions[0].accepted);
  EXPECT_EQ(run.map.landmarks.size(), 1U);
}

TEST(LandmarkAssociator, AnIdentifiedMeasurementThatDoesNotFitHasNoWeight) {
  DotRun run;
  run.see({{{1, 2}, 7}});
  const auto decisions = run.see({{{4, 2}, 7}});
  EXPECT_FALSE(decisions[0].accepted);
  EXPECT_EQ(decisions[0].reason, "gated out: not where its landmark is; kept without weight");
  EXPECT_EQ(run.map.landmarks.size(), 1U);
  EXPECT_EQ(run.landmark(0).evidence, 1U);
  const auto factors = run.view().factorsOf(run.landmark(0).id);
  ASSERT_EQ(factors.size(), 2U);
  EXPECT_EQ(run.graph.factor(factors[1]).weight, 0);
}

TEST(LandmarkAssociator, AnIdentifiedLandmarkIsNoneThatOthersMayBe) {
  DotRun run;
  run.see({{{1, 2}, 7}});
  const auto decisions = run.see({{{1.02, 2}}, {{1, 2}, 7}});
  EXPECT_EQ(decisions[0].reason, "matched") << "the identified one is taken first";
  EXPECT_EQ(decisions[1].reason, "new: none is near");
  EXPECT_EQ(run.measurementsOf(0), 2);
}

TEST(LandmarkAssociator, AMatchThatWouldTieASessionToTheMapIsAHypothesis) {
  DotRun run;
  run.see({{{1, 2}}});
  run.graph.setSession(1);
  run.map.sessions.push_back({1, "second", {}, false});
  const auto decisions = run.see({{{1, 2}}});
  ASSERT_EQ(decisions.size(), 1U);
  EXPECT_TRUE(decisions[0].hypothesis);
  EXPECT_EQ(decisions[0].reason, "waits for the consistency test");
  EXPECT_EQ(run.landmark(0).evidence, 1U);
  const auto factors = run.view().factorsOf(run.landmark(0).id);
  ASSERT_EQ(factors.size(), 2U);
  EXPECT_TRUE(run.graph.factor(factors[1]).tags.hypothesis);
}

}  // namespace
}  // namespace omnimapper::landmarks::landmark_associator_test
