// Findings on stamps.
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
  EXPECT_TRUE(checked.says("a stamp is repeated")) << checked.text();
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

// The robot stands for a while, and nothing is recorded meanwhile.
Observations restingIn(Observations log, double seconds) {
  const auto from = log[log.size() / 5]->timestamp;  // on a straight
  for (const auto& observation : log) {
    if (observation->timestamp > from) observation->timestamp += base::durationFromSeconds(seconds);
  }
  return log;
}

// The laser is silent for a while, and the other sensors go on.
Observations blindFor(Observations log, double seconds) {
  const auto start = log.front()->timestamp;
  const auto is_missing = [&](const auto& observation) {
    const double t = base::secondsBetween(start, observation->timestamp);
    return observation->sensorLabel == "laser" && t > 10 && t < 10 + seconds;
  };
  log.erase(std::remove_if(log.begin(), log.end(), is_missing), log.end());
  return log;
}

TEST(Stamps, ThatPauseAreAGapUnlessTheRobotRests) {
  const Checked driving(blindFor(halfALap(), 8));
  EXPECT_TRUE(
      driving.says("warning: 'laser': 1 gap in which the robot may have moved, the longest of 8.1 s (the usual "
                   "interval is 0.100 s)"))
      << driving.text();
  const Checked resting(restingIn(halfALap(), 8));
  EXPECT_TRUE(resting.says("note: 'laser': 1 gap in which the robot moved by less than 1.5 m")) << resting.text();
  EXPECT_FALSE(resting.says("warning")) << resting.text();
}

TEST(Stamps, OfALogRecordedByDistanceMayPauseForMinutes) {
  // A scan every 0.2 m, then every 0.6 m.
  auto log = restingIn(halfALap(), 200);
  Observations by_distance;
  std::size_t scans = 0, next = 0;
  for (const auto& observation : log) {
    if (dynamic_cast<const CObservation2DRangeScan*>(observation.get())) {
      if (scans++ < next) continue;
      next = scans + 2 + 6 * (by_distance.size() / 20 % 2);
      by_distance.push_back(observation);
    } else if (!by_distance.empty() && by_distance.back()->sensorLabel == "laser") {
      by_distance.push_back(observation);
    }
  }
  const Checked checked(by_distance);
  EXPECT_FALSE(checked.says("clock")) << checked.text();
  EXPECT_TRUE(checked.says("note: 'laser': 1 gap in which the robot moved by less than 1.5 m")) << checked.text();
}

TEST(Stamps, OfOneSensorThatPausesAreNoJumpOfTheClock) {
  const Checked checked(blindFor(halfALap({testing::SimulatedLaser()}, [](auto& options) { options.laps = 3; }), 65));
  EXPECT_FALSE(checked.says("clock")) << checked.text();
  EXPECT_TRUE(checked.says("warning: 'laser': 1 gap in which the robot may have moved, the longest of 65"))
      << checked.text();
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
