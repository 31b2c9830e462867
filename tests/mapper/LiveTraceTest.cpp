#include <gtest/gtest.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "run/LiveTrace.h"
#include "run/ReplayFeed.h"

namespace omnimapper::mapper::live_trace_test {
namespace {

using Kind = live::JournalEvent::Kind;

FrameBundle bundleOf(std::vector<std::future<PerceivedParts>> parts) {
  FrameBundle bundle;
  bundle.observations = std::move(parts);
  return bundle;
}

TEST(LatencyCounts, tellsQuantilesToFivePercent) {
  LatencyCounts counts;
  EXPECT_EQ(counts.quantile(0.5), 0);
  for (int i = 1; i <= 1000; ++i) counts.add(0.001 * i);
  EXPECT_NEAR(counts.quantile(0.5), 0.5, 0.05 * 0.5);
  EXPECT_NEAR(counts.quantile(0.99), 0.99, 0.05 * 0.99);
  counts.add(-3);    // a stamp from the future
  counts.add(1e12);  // and one from long ago
  EXPECT_GT(counts.quantile(1), 1e5);
}

TEST(LiveSchedule, takesABundleWhenItsPerceptionIsDone) {
  const testing::ScratchFolder folder;
  const auto trace = std::make_shared<LiveTrace>();
  trace->journal.emplace(folder / "log.journal");
  LiveSchedule schedule(trace);
  std::promise<PerceivedParts> first, second;
  std::vector<std::future<PerceivedParts>> parts;
  parts.push_back(first.get_future());
  parts.push_back(second.get_future());
  const auto bundle = bundleOf(std::move(parts));
  EXPECT_FALSE(schedule.takesBundle(bundle, 100));
  second.set_value({});
  EXPECT_FALSE(schedule.takesBundle(bundle, 100));
  first.set_value({});
  EXPECT_TRUE(schedule.takesBundle(bundle, 1));
  EXPECT_FALSE(schedule.takesJob(true, false)) << "a job is never waited for";
  EXPECT_TRUE(schedule.takesJob(false, true));
  schedule.end();
  EXPECT_TRUE(schedule.takesJob(true, false)) << "but at the end, as on a log";
  EXPECT_FALSE(schedule.takesJob(false, true));
  trace->journal->flush();
  std::ifstream in(folder / "log.journal");
  std::ostringstream text;
  text << in.rdbuf();
  EXPECT_EQ(text.str(), "omnimapper journal 1\nb\nj\n") << "what is done at the end needs no journal";
}

TEST(ReplaySchedule, takesWhatTheJournalSays) {
  const auto cursor = std::make_shared<ReplayCursor>();
  cursor->journal.events = {{Kind::bundle, 0}, {Kind::job, 0}, {Kind::add, 1}};
  ReplaySchedule schedule(cursor);
  EXPECT_FALSE(schedule.takesJob(true, true)) << "the bundle comes first";
  EXPECT_TRUE(schedule.takesBundle({}, 1));
  EXPECT_FALSE(schedule.takesBundle({}, 100));
  EXPECT_TRUE(schedule.takesJob(false, false));
  EXPECT_FALSE(schedule.takesJob(true, true));
  EXPECT_FALSE(schedule.takesBundle({}, 100));
  cursor->has_departed = true;
  EXPECT_TRUE(schedule.takesBundle({}, 100)) << "as on a log";
}

}  // namespace
}  // namespace omnimapper::mapper::live_trace_test
