#include <gtest/gtest.h>
#include <omnimapper/plugin/StageTimes.h>

#include <chrono>
#include <thread>

namespace omnimapper::mapper::stage_times_test {
namespace {

void work(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

TEST(StageTimes, ATimerWithinAnotherStopsIt) {
  StageTimes times;
  const StopWatch watch;
  {
    const auto outer = times.measure(Stage::engine);
    work(2);
    for (int i = 0; i < 2; ++i) {
      const auto inner = times.measure(Stage::plugin, "laser");
      work(40);
      const auto innermost = times.measure(Stage::solve);
      work(2);
    }
    work(2);
  }
  const double all = watch.seconds();
  const auto& totals = times.totals();
  EXPECT_EQ(totals.at("engine").calls, 1U);
  EXPECT_EQ(totals.at("plugin laser").calls, 2U);
  EXPECT_EQ(totals.at("solve").calls, 2U);
  EXPECT_GE(totals.at("engine").seconds, 0.004);
  EXPECT_GE(totals.at("plugin laser").seconds, 0.08);
  EXPECT_GE(totals.at("solve").seconds, 0.004);
  double sum = 0;
  for (const auto& [stage, total] : totals) sum += total.seconds;
  EXPECT_LE(sum, all) << "a second counts once";
}

TEST(StageTimes, AKeyFramesWorkIsWhatPassedSinceTheMarkWithoutWaiting) {
  StageTimes times;
  times.add(Stage::plugin, "laser", 100);  // before
  const auto begin = times.mark();
  times.add(Stage::plugin, "laser", 0.003);
  times.add(Stage::plugin, "planes", 0.002);
  times.add(Stage::solve, "", 0.004);
  times.add(Stage::job_wait, "", 0.5);
  times.add(Stage::perception_wait, "", 0.25);
  times.addKeyFrameSince(begin);
  ASSERT_EQ(times.keyFrames().size(), 1U);
  EXPECT_NEAR(times.keyFrames()[0].plugins_ms, 5, 1e-9);
  EXPECT_NEAR(times.keyFrames()[0].solve_ms, 4, 1e-9);
  EXPECT_LT(times.keyFrames()[0].engine_ms, -750) << "these times were not spent: the clock ran for less than they say";
}

}  // namespace
}  // namespace omnimapper::mapper::stage_times_test
