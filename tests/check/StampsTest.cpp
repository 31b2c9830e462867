// Findings about stamps.
#include "CheckedLog.h"

namespace omnimapper::check::stamps_test {
namespace {

TEST(Stamps, OfAGoodLogHaveTheirRateAndNothingIsSaidOrProposed) {
  const Checked checked(halfALap());
  EXPECT_EQ(checked.text(), "");
  EXPECT_EQ(toIni(checked.settings), "");
  const auto& laser = checked.facts.sensors.at({"laser", "mrpt::obs::CObservation2DRangeScan"});
  EXPECT_NEAR(laser.period, 0.1, 1e-3);
  EXPECT_NEAR(laser.longest_gap, 0.1, 1e-3);
  EXPECT_LT(laser.lateness, 1e-3);
}

TEST(Stamps, ThatAreMissingOrRepeatedAreCounted) {
  auto log = halfALap();
  int n = 0;
  base::Stamp last;
  each<CObservation2DRangeScan>(log, [&](auto& scan) {
    if (++n % 50 == 0) scan.timestamp = base::Stamp();
    if (n % 50 == 10) scan.timestamp = last;
    last = scan.timestamp;
  });
  const Checked checked(log);
  const auto& laser = checked.facts.sensors.at({"laser", "mrpt::obs::CObservation2DRangeScan"});
  EXPECT_EQ(laser.no_stamp, static_cast<std::size_t>(n / 50));
  EXPECT_EQ(laser.repeated, static_cast<std::size_t>((n + 40) / 50));
  EXPECT_TRUE(checked.says("without a stamp")) << checked.text();
  EXPECT_TRUE(checked.says("is repeated")) << checked.text();
}

TEST(Stamps, ThatNeverComeAreAProblem) {
  auto log = halfALap();
  each<CObservation2DRangeScan>(log, [](auto& scan) { scan.timestamp = base::Stamp(); });
  EXPECT_TRUE(Checked(log).says("problem: 'laser'"));
}

TEST(Stamps, OfAClockThatIsSetAreAJump) {
  for (const double seconds : {3600.0, -3600.0}) {
    auto log = halfALap();
    for (std::size_t i = log.size() / 2; i < log.size(); ++i) log[i]->timestamp += base::durationFromSeconds(seconds);
    const Checked checked(log);
    EXPECT_TRUE(
        checked.says("problem: 'laser': the clock jumps 1 time, by up to " + std::string(seconds > 0 ? "36" : "-3")))
        << checked.text();
  }
}

TEST(Stamps, OfOneObservationFarAheadDoNotStretchTheLog) {
  auto log = halfALap();
  log[log.size() / 2]->timestamp += std::chrono::hours(24 * 365);
  const Checked checked(log);
  for (const auto& [sensor, stamps] : checked.facts.sensors) {
    EXPECT_LT(base::secondsBetween(stamps.first, stamps.last), 100) << sensor.first;
  }
}

TEST(Stamps, ThatPauseAreAGap) {
  auto log = halfALap();
  for (std::size_t i = log.size() / 2; i < log.size(); ++i) log[i]->timestamp += base::durationFromSeconds(8);
  const Checked checked(log);
  EXPECT_TRUE(checked.says("warning: 'laser': 1 gap, the longest of 8.1 s (usually 0.100 s)")) << checked.text();
}

TEST(Stamps, ThatComeLateWidenTheWindow) {
  auto log = halfALap();
  // Each scan arrives 0.9 s late, behind later odometry.
  const auto arrival = [](const auto& o) {
    return o->timestamp + base::durationFromSeconds(o->sensorLabel == "laser" ? 0.9 : 0.0);
  };
  std::stable_sort(log.begin(), log.end(), [&](const auto& a, const auto& b) { return arrival(a) < arrival(b); });
  const Checked checked(log);
  EXPECT_TRUE(checked.says("warning: 'laser': comes up to 0.9 s after later stamps")) << checked.text();
  EXPECT_EQ(checked.proposed("mapper", "window_s"), "1.0");
}

}  // namespace
}  // namespace omnimapper::check::stamps_test
