#include <gtest/gtest.h>

#include "Dots.h"

namespace omnimapper::landmarks::landmark_plugin_test {
namespace {

// Two landmarks of one dot: the second one is made by a batch that did not know the first.
void seeTwice(DotRun& run, double apart) {
  run.see({{{1, 2}}});
  DotPlugin forgetful;
  const auto frame = run.addFrame({0, 0, 0, 0, 0, 0});
  run.graph.setFixed(frame.pose, true);
  PreparedDots prepared;
  prepared.dots = {{{1 + apart, 2}}};
  const mrpt::obs::CObservationBearingRange observation;
  run.applied(forgetful.measure(frame, {observation, &prepared}, run.view()), frame.stamp);
}

TEST(LandmarkPlugin, LandmarksThatAreOneAreMergedAtTheEnd) {
  DotRun run;
  seeTwice(run, 0.2);
  ASSERT_EQ(run.plugin.index().all().size(), 2U);
  const auto decisions = run.finish();
  ASSERT_EQ(decisions.size(), 1U);
  EXPECT_EQ(decisions[0].reason, "two landmarks are the same");
  EXPECT_NEAR(decisions[0].numbers.at(2).second, 2, 1e-9) << "chi-square: 0.04 / 0.02";
  EXPECT_EQ(run.view().candidates("dots").size(), 1U);
  EXPECT_EQ(run.landmark(0).evidence, 2U);
  EXPECT_EQ(run.measurementsOf(0), 2);
  run.finish();
  EXPECT_EQ(run.plugin.index().all().size(), 1U) << "the index follows the map";
  EXPECT_EQ(run.see({{{1.1, 2}}})[0].reason, "matched");
}

TEST(LandmarkPlugin, LandmarksThatDifferStayApart) {
  DotRun run;
  seeTwice(run, 0.6);
  EXPECT_TRUE(run.finish().empty());
  EXPECT_EQ(run.view().candidates("dots").size(), 2U);
}

TEST(LandmarkPlugin, MergesOnceAfterEachSolve) {
  DotRun run;
  seeTwice(run, 0.2);
  run.uncertainty = mapper::Uncertainty(run.graph);
  const auto& frame = run.map.key_frames.back();
  EXPECT_TRUE(run.plugin.afterCommit(frame, run.view()).batch.empty()) << "nothing was solved";
  run.solves.emplace_back();
  EXPECT_EQ(run.plugin.afterCommit(frame, run.view()).batch.merges().size(), 1U);
  EXPECT_TRUE(run.plugin.afterCommit(frame, run.view()).batch.empty());
}

TEST(LandmarkPlugin, InAHeldMapNothingIsMerged) {
  DotRun run;
  seeTwice(run, 0.2);
  run.map_is_held = true;
  run.solves.emplace_back();
  EXPECT_TRUE(run.plugin.afterCommit(run.map.key_frames.back(), run.view()).batch.empty());
  EXPECT_TRUE(run.finish().empty());
}

TEST(LandmarkPlugin, KnowsTheLandmarksOfAMapThatIsContinued) {
  DotRun run;
  run.see({{{1, 2}}, {{4, 2}}, {{7, 2}}});
  mapper::Batch batch;
  batch.retireLandmark({0, 1});
  mapper::apply(batch, {"dots", {}}, run.graph, run.map);
  mapper::Batch foreign;
  foreign.addLandmark("thing", {foreign.addVariable(graph::point2(), Eigen::Vector2d(9, 9))});
  mapper::apply(foreign, {"others", {}}, run.graph, run.map);
  run.plugin = DotPlugin();
  EXPECT_TRUE(run.plugin.index().all().empty());
  run.plugin.restore(nullptr, run.view());
  ASSERT_EQ(run.plugin.index().all().size(), 2U) << "neither the retired one nor that of another plugin";
  EXPECT_EQ(run.plugin.index().all().count({0, 1}), 0U);
  const auto decisions = run.see({{{1, 2}}, {{7, 2}}});
  EXPECT_EQ(decisions[0].reason, "matched");
  EXPECT_EQ(decisions[1].reason, "matched");
  EXPECT_EQ(run.plugin.index().at({0, 2}).variable, run.landmark(2).variables.front());
}

TEST(LandmarkIndex, FindsTheNewestAndDropsWhatIsRetired) {
  DotRun run;
  run.see({{{1, 2}}, {{4, 2}}, {{7, 2}}});
  LandmarkIndex<> index("dots");
  index.restore(run.view());
  const auto any = [](const KnownLandmark&) { return true; };
  ASSERT_TRUE(index.newest(any));
  EXPECT_EQ(index.newest(any)->id, (base::LandmarkId{0, 2}));
  mapper::Batch batch;
  batch.retireLandmark({0, 2});
  mapper::apply(batch, {"dots", {}}, run.graph, run.map);
  index.update(run.view());
  EXPECT_EQ(index.newest(any)->id, (base::LandmarkId{0, 1}));
  EXPECT_EQ(index.newest([](const KnownLandmark&) { return false; }), nullptr);
}

TEST(LandmarkMerging, MergesSeveralIntoOneButNotInChains) {
  DotRun run;
  run.see({{{1, 2}}, {{4, 2}}, {{7, 2}}, {{10, 2}}});
  const base::LandmarkId a{0, 0}, b{0, 1}, c{0, 2}, d{0, 3};
  const std::string section = "dots";
  const auto view = run.view();
  LandmarkMerging<DotPayload> merging(view, section);
  merging.merge(a, b, {1, 5, "they look alike"});
  merging.merge(a, c, {2, 5, ""});
  EXPECT_FALSE(merging.mayMerge(a, b)) << "it is gone";
  EXPECT_FALSE(merging.mayMerge(b, d)) << "it is gone";
  EXPECT_FALSE(merging.mayMerge(d, a)) << "others were merged into it";
  EXPECT_TRUE(merging.mayMerge(a, d));
  EXPECT_TRUE(merging.isGone(c));
  EXPECT_EQ(merging.partsOf(a), (std::vector{b, c}));
  EXPECT_EQ(merging.payloadOf(a).measurements, 3);
  EXPECT_EQ(merging.payloadOf(d).measurements, 1);
  merging.describe(d, std::make_shared<DotPayload>(5, 1));
  const auto decisions = run.applied(merging.take(), {});
  ASSERT_EQ(decisions.size(), 2U);
  EXPECT_EQ(decisions[0].reason, "two landmarks are the same: they look alike");
  EXPECT_EQ(run.view().candidates("dots"), (std::vector{a, d}));
  EXPECT_EQ(run.measurementsOf(0), 3);
  EXPECT_EQ(run.landmark(0).evidence, 3U);
  EXPECT_EQ(dynamic_cast<const DotPayload&>(*run.landmark(3).payload).number, 5);
}

TEST(Fit, OfAGapWorkedByHand) {
  DotRun run;
  run.see({{{1, 2}}, {{1.3, 2.4}}});
  run.uncertainty = mapper::Uncertainty(run.graph);
  const auto a = run.landmark(0).variables.front(), b = run.landmark(1).variables.front();
  // 0.5 m apart, each known to 0.1 m: 0.25 / 0.02. With a further 0.1 m: 0.25 / 0.03.
  EXPECT_NEAR(fitOfGap(a, b, run.view())->chi2, 12.5, 1e-9);
  const auto fit = fitOfGap(a, b, run.view(), 0.1);
  EXPECT_NEAR(fit->chi2, 0.25 / 0.03, 1e-9);
  EXPECT_NEAR(fit->log_density, -0.5 * fit->chi2 - std::log(2 * M_PI * 0.03), 1e-9);
}

}  // namespace
}  // namespace omnimapper::landmarks::landmark_plugin_test
