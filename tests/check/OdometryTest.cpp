// Findings on odometry, which is compared with the motion of the scans.
#include "CheckedLog.h"

namespace omnimapper::check::odometry_test {
namespace {

using mrpt::poses::CPose2D;
using testing::SimulatedLogOptions;

constexpr const char* kWithoutOdometry = "scan_odometry, no_motion";

TEST(Odometry, ThatIsAbsentIsSaidAndItsPluginLeftOut) {
  auto log = halfALap();
  log.erase(std::remove_if(log.begin(), log.end(), [](const auto& o) { return o->sensorLabel == "odometry"; }),
            log.end());
  const Checked checked(log);
  EXPECT_EQ(checked.text(), "warning: there is no odometry: the motion is estimated from the scans alone\n");
  EXPECT_EQ(checked.proposed("mapper", "pose_plugins"), kWithoutOdometry);
}

TEST(Odometry, ThatStandsStillWhileTheScansMoveIsFrozen) {
  auto log = halfALap();
  each<CObservationOdometry>(log, [](auto& odometry) { odometry.odometry = CPose2D(1, 2, 3); });
  const Checked checked(log);
  EXPECT_TRUE(checked.says("problem: 'odometry': measures no motion in")) << checked.text();
  EXPECT_TRUE(checked.says("frozen")) << checked.text();
  EXPECT_EQ(checked.proposed("mapper", "pose_plugins"), kWithoutOdometry);
}

TEST(Odometry, ThatFreezesForAWhileIsSaidWithTheTime) {
  auto log = halfALap();
  const auto start = log.front()->timestamp;
  CPose2D held, offset;
  each<CObservationOdometry>(log, [&](auto& odometry) {
    const double t = base::secondsBetween(start, odometry.timestamp);
    if (t > 10 && t < 20) odometry.odometry = held;
    held = odometry.odometry;
  });
  const Checked checked(log);
  EXPECT_TRUE(checked.says("first 10.0 s after the start")) << checked.text();
}

TEST(Odometry, ThatRunsAgainstTheScansIsReversed) {
  auto log = halfALap();
  each<CObservationOdometry>(log, [](auto& odometry) {
    // The sum that encoders with swapped signs give.
    const auto& p = odometry.odometry;
    odometry.odometry = CPose2D(-p.x(), p.y(), -p.phi());
  });
  const Checked checked(log);
  EXPECT_TRUE(checked.says("problem: 'odometry': is reversed compared with the scans")) << checked.text();
  EXPECT_EQ(checked.proposed("mapper", "pose_plugins"), kWithoutOdometry);
  EXPECT_EQ(checked.proposed("mapper", "sensors"), "") << "the laser is not to blame";
}

TEST(Odometry, ThatJumpsIsSaidWithTheTime) {
  auto log = halfALap();
  const auto start = log.front()->timestamp;
  each<CObservationOdometry>(log, [&](auto& odometry) {
    if (base::secondsBetween(start, odometry.timestamp) > 12.01)
      odometry.odometry = CPose2D(3, 4, 0) + odometry.odometry;
  });
  const Checked checked(log);
  EXPECT_TRUE(checked.says("problem: 'odometry': jumps 1 time, by up to 5.0")) << checked.text();
  EXPECT_TRUE(checked.says("12.1 s after the start")) << checked.text();
}

TEST(Odometry, ItsNoiseIsMeasuredAndProposedIfFarFromTheDefault) {
  const auto noisy = [](SimulatedLogOptions& options) {
    options.laps = 1;
    options.position_noise_per_root_m = 0.2;
    options.yaw_noise_per_root_turn = 0.2;
  };
  const Checked checked(halfALap({testing::SimulatedLaser()}, noisy));
  EXPECT_TRUE(checked.says("times the default")) << checked.text();
  // The simulated noise is along x only.
  EXPECT_NEAR(std::stod(checked.proposed("odometry", "position_noise_per_root_m")), 0.2 / std::sqrt(2), 0.06);
  EXPECT_NEAR(std::stod(checked.proposed("odometry", "yaw_noise_per_root_turn")), 0.2, 0.08);
}

TEST(Odometry, ThatMeasuresTooFarIsSaid) {
  const Checked checked(halfALap({testing::SimulatedLaser()}, [](auto& options) { options.travel_scale = 1.2; }));
  EXPECT_TRUE(checked.says("warning: 'odometry': measures 1.2")) << checked.text();
}

TEST(Odometry, OfAnotherTimeThanTheScansIsAProblem) {
  auto log = halfALap();
  each<CObservationOdometry>(log, [](auto& odometry) { odometry.timestamp += std::chrono::hours(1); });
  const Checked checked(log);
  EXPECT_TRUE(checked.says("problem: 'odometry' and 'laser': 100 % of the scans lie outside")) << checked.text();
  EXPECT_TRUE(checked.says("the odometry starts 36")) << checked.text();
  EXPECT_EQ(checked.proposed("mapper", "pose_plugins"), kWithoutOdometry);
}

TEST(Odometry, OfTwoTheOneNearerToTheScansIsProposed) {
  auto log = halfALap();
  Observations all;
  for (const auto& observation : log) {
    all.push_back(observation);
    if (!dynamic_cast<const CObservationOdometry*>(observation.get())) continue;
    auto other = std::dynamic_pointer_cast<CObservationOdometry>(observation->duplicateGetSmartPtr());
    other->sensorLabel = "a_worse_one";
    other->odometry = CPose2D(1.3 * other->odometry.x(), 0.7 * other->odometry.y(), other->odometry.phi());
    all.push_back(other);
  }
  const Checked checked(all);
  EXPECT_EQ(checked.proposed("odometry", "label"), "odometry");
  EXPECT_EQ(checked.proposed("scan_odometry", "odometry_label"), "odometry");
}

TEST(Odometry, OfTwoThatAreAsNearNoneIsShutOut) {
  const auto log = halfALap();
  Observations all;
  for (const auto& observation : log) {
    all.push_back(observation);
    if (!dynamic_cast<const CObservationOdometry*>(observation.get())) continue;
    auto other = std::dynamic_pointer_cast<CObservationOdometry>(observation->duplicateGetSmartPtr());
    other->sensorLabel = "the_same_again";
    all.push_back(other);
  }
  EXPECT_EQ(Checked(all).proposed("odometry", "label"), "");
  EXPECT_EQ(Checked(all).proposed("scan_odometry", "odometry_label"), "");
}

TEST(Odometry, ItsNoiseIsNotProposedWhereItOnlyFillsGaps) {
  const Checked checked(halfALap({testing::SimulatedLaser()}, [](SimulatedLogOptions& options) {
    options.laps = 1;
    options.yaw_noise_per_root_turn = 0.2;
  }));
  ASSERT_NE(checked.proposed("odometry", "yaw_noise_per_root_turn"), "");
  const PluginLists gaps{{"scan_odometry", "odometry", "no_motion"}, {"laser_points"}, {"loop_closure"}, true};
  EXPECT_EQ(toIni(proposeIni(checked.facts, gaps)), "");
  const PluginLists alone{{"odometry", "no_motion"}, {"laser_points"}, {"loop_closure"}, true};
  EXPECT_NE(toIni(proposeIni(checked.facts, alone)), "") << "without the laser's odometry it alone measures the motion";
}

/// A log with a second odometry, which has the first one's readings changed by `change`.
Observations withAnother(const Observations& log,
                         const std::function<CPose2D(const CPose2D&, double seconds)>& change) {
  Observations all;
  const auto start = log.front()->timestamp;
  for (const auto& observation : log) {
    all.push_back(observation);
    if (!dynamic_cast<const CObservationOdometry*>(observation.get())) continue;
    auto other = std::dynamic_pointer_cast<CObservationOdometry>(observation->duplicateGetSmartPtr());
    other->sensorLabel = "other";
    other->odometry = change(other->odometry, base::secondsBetween(start, other->timestamp));
    all.push_back(other);
  }
  return all;
}

TEST(Odometry, ThatContradictsAnotherIsSaidWithTheTime) {
  const auto log = halfALap();
  const auto freezes = [held = CPose2D()](const CPose2D& pose, double seconds) mutable {
    if (seconds < 10) held = pose;
    return held;
  };
  const Checked frozen(withAnother(log, freezes));
  EXPECT_TRUE(frozen.says("warning: 'odometry' and 'other': the two odometries contradict each other in"))
      << frozen.text();
  // Spans are of a second and a reading.
  const auto& pair = frozen.facts.odometry_pairs.at(0);
  EXPECT_NEAR(base::secondsBetween(log.front()->timestamp, pair.first_contrary), 9.5, 1.1);
  EXPECT_GT(pair.contrary, pair.spans / 4);
  EXPECT_LT(pair.contrary, pair.spans);

  const Checked elsewhere(withAnother(log, [](const CPose2D& pose, double) { return CPose2D(40, -3, 2) + pose; }));
  EXPECT_FALSE(elsewhere.says("contradict")) << "the frame of an odometry is its own; " << elsewhere.text();
  const Checked scaled(withAnother(
      log, [](const CPose2D& pose, double) { return CPose2D(1.1 * pose.x(), 1.1 * pose.y(), pose.phi()); }));
  EXPECT_FALSE(scaled.says("contradict")) << scaled.text();
}

TEST(Odometry, ThatTurnsTooFarIsNotBlamedOnTheLaser) {
  auto log = halfALap();
  CPose2D before, summed;
  each<CObservationOdometry>(log, [&](auto& odometry) {
    const CPose2D step = odometry.odometry - before;
    before = odometry.odometry;
    summed = summed + CPose2D(step.x(), step.y(), 1.5 * step.phi());
    odometry.odometry = summed;
  });
  const Checked checked(log);
  EXPECT_TRUE(checked.says("warning: 'odometry': measures a turn of 1.4")) << checked.text();
  EXPECT_FALSE(checked.says("declare")) << checked.text();
}

TEST(Odometry, ThatIsNoNumberIsCounted) {
  auto log = halfALap();
  int n = 0;
  each<CObservationOdometry>(log, [&](auto& odometry) {
    if (++n % 100 == 0) odometry.odometry.x(std::numeric_limits<double>::quiet_NaN());
  });
  EXPECT_TRUE(Checked(log).says("not finite"));
}

}  // namespace
}  // namespace omnimapper::check::odometry_test
