// Findings on 2D scans and the pose of their laser.
#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CObservationIMU.h>

#include <algorithm>

#include "CheckedLog.h"

namespace omnimapper::check::scans_test {
namespace {

using mrpt::poses::CPose3D;
using testing::SimulatedLaser;

void setRanges(CObservation2DRangeScan& scan, float range, bool valid) {
  for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
    scan.setScanRange(i, range);
    scan.setScanRangeValidity(i, valid);
  }
}

/// A log whose laser has one pose and states another.
Observations mounted(const CPose3D& truly, const CPose3D& said) {
  SimulatedLaser laser;
  laser.base_from_sensor = truly;
  auto log = halfALap({laser});
  each<CObservation2DRangeScan>(log, [&](auto& scan) { scan.sensorPose = said; });
  return log;
}

TEST(Scans, AreDescribed) {
  const Checked checked(halfALap());
  const auto& scans = checked.facts.scans.at("laser");
  EXPECT_EQ(scans.beams, 181U);
  EXPECT_NEAR(scans.aperture, kPi, 1e-6);
  EXPECT_EQ(scans.max_range, 12);
  EXPECT_GT(scans.valid_share, 0.9);
  EXPECT_GT(scans.median_range, 1);
  EXPECT_LT(scans.longest, 12.1);
  EXPECT_EQ(scans.blind + scans.empty + scans.repeated + scans.other_beams, 0U);
}

TEST(Scans, OfZerosOfMaximumRangeAndWithoutBeamsAreCounted) {
  auto log = halfALap();
  int n = 0;
  each<CObservation2DRangeScan>(log, [&](auto& scan) {
    ++n;
    if (n % 40 == 0) setRanges(scan, 0, true);
    if (n % 40 == 1) setRanges(scan, scan.maxRange, false);
    if (n % 40 == 2) setRanges(scan, scan.maxRange, true);
    if (n % 40 == 3) scan.resizeScan(0);
  });
  const Checked checked(log);
  const auto& scans = checked.facts.scans.at("laser");
  EXPECT_EQ(scans.all_zero, static_cast<std::size_t>(n / 40));
  EXPECT_EQ(scans.all_maximum, static_cast<std::size_t>((n + 39) / 40 + (n + 38) / 40));
  EXPECT_EQ(scans.empty, static_cast<std::size_t>((n + 37) / 40));
  EXPECT_TRUE(checked.says("warning: 'laser': ")) << checked.text();
  EXPECT_TRUE(checked.says("all zeros")) << checked.text();
  EXPECT_TRUE(checked.says("all at maximum range")) << checked.text();
}

TEST(Scans, OfOtherNumbersOfBeamsAreCountedWithTheirRange) {
  auto log = halfALap();
  int n = 0;
  each<CObservation2DRangeScan>(log, [&](auto& scan) { scan.resizeScan(scan.getScanSize() + (n++ % 3 == 1 ? 4 : 0)); });
  const Checked checked(log);
  EXPECT_EQ(checked.facts.scans.at("laser").other_beams, static_cast<std::size_t>((n + 1) / 3));
  EXPECT_TRUE(checked.says("have another number of beams than the first one, 181 to 185")) << checked.text();
}

TEST(Scans, WhoseBeamsRunClockwiseAreNotedAndMixedOnesWarnedOf) {
  auto log = halfALap();
  each<CObservation2DRangeScan>(log, [](auto& scan) {
    const auto ranges = scan;
    const std::size_t last = scan.getScanSize() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      scan.setScanRange(i, ranges.getScanRange(last - i));
      scan.setScanRangeValidity(i, ranges.getScanRangeValidity(last - i));
    }
    scan.rightToLeft = false;
  });
  const Checked clockwise(log);
  EXPECT_TRUE(clockwise.says("note: 'laser': its beams run clockwise")) << clockwise.text();
  EXPECT_FALSE(clockwise.says("problem")) << clockwise.text();
  auto with_empty = halfALap();
  int n = 0;
  each<CObservation2DRangeScan>(with_empty, [&](auto& scan) {
    scan.rightToLeft = false;
    if (n++ == 5) scan.resizeScan(0);
  });
  const Checked but_one(with_empty);
  EXPECT_TRUE(but_one.says("note: 'laser': its beams run clockwise")) << "an empty scan runs neither way";
  EXPECT_FALSE(but_one.says("do two lasers share the label?")) << but_one.text();
  n = 0;
  each<CObservation2DRangeScan>(log, [&](auto& scan) { scan.rightToLeft = n++ % 2 == 0; });
  EXPECT_TRUE(Checked(log).says("do two lasers share the label?"));
}

TEST(Scans, AllBlindLeaveNothingToMap) {
  auto log = halfALap();
  each<CObservation2DRangeScan>(log, [](auto& scan) { setRanges(scan, 0, true); });
  const Checked checked(log);
  EXPECT_TRUE(checked.says("problem: no laser has scans that can be matched")) << checked.text();
  EXPECT_TRUE(usableLasers(checked.facts).empty());
}

TEST(Scans, ThatNeverChangeAreAStuckSensor) {
  auto log = halfALap();
  const CObservation2DRangeScan* first = nullptr;
  each<CObservation2DRangeScan>(log, [&](auto& scan) {
    if (!first) first = &scan;
    for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
      scan.setScanRange(i, first->getScanRange(i));
      scan.setScanRangeValidity(i, first->getScanRangeValidity(i));
    }
  });
  EXPECT_TRUE(Checked(log).says("is the sensor stuck?"));
}

TEST(Scans, WhoseMissesAreMarkedAsValidGetALimit) {
  auto log = halfALap();
  each<CObservation2DRangeScan>(log, [](auto& scan) {
    scan.maxRange = 30;
    for (std::size_t i = 0; i < scan.getScanSize(); i += 5) {
      scan.setScanRange(i, 8.183F);
      scan.setScanRangeValidity(i, true);
    }
    for (std::size_t i = 0; i < scan.getScanSize(); ++i) scan.setScanRange(i, std::min(8.183F, scan.getScanRange(i)));
  });
  const Checked checked(log);
  EXPECT_TRUE(checked.says("exactly 8.18 m")) << checked.text();
  EXPECT_EQ(checked.proposed("laser_points", "max_range_m"), "8.10");
  EXPECT_EQ(checked.proposed("scan_odometry", "max_range_m"), "8.10");
  EXPECT_EQ(checked.proposed("laser_lines", "max_range_m"), "") << "an INI without it gets no keys for it";
  const auto with_lines = proposeIni(checked.facts, {{"no_motion"}, {"laser_lines"}, {"walls"}});
  EXPECT_NE(toIni(with_lines).find("[laser_lines]\nmax_range_m = 8.10"), std::string::npos) << toIni(with_lines);
}

TEST(Scans, OfATiltedPlaneAreLeftOut) {
  SimulatedLaser level, tilted;
  tilted.label = "tilted";
  tilted.base_from_sensor = CPose3D(0.2, 0, 1, 0, 0.6, 0);
  const Checked checked(halfALap({level, tilted}));
  EXPECT_TRUE(checked.says("problem: 'tilted': scans a plane tilted by 34 deg")) << checked.text();
  EXPECT_EQ(checked.proposed("loop_closure", "labels"), "laser.points");
  EXPECT_EQ(checked.proposed("scan_odometry", "label"), "laser");
}

TEST(Scans, OfTwoLasersTheOneThatSeesMoreIsTheReference) {
  SimulatedLaser narrow, wide;
  narrow.label = "a_narrow";
  narrow.aperture = 2;
  wide.label = "b_wide";
  const Checked checked(halfALap({narrow, wide}));
  EXPECT_EQ(checked.text(), "");
  EXPECT_EQ(checked.proposed("mapper", "reference_sensor"), "b_wide");
  EXPECT_EQ(checked.proposed("scan_odometry", "label"), "b_wide");
  const auto without = proposeIni(checked.facts, {{"odometry", "no_motion"}, {"laser_points"}, {"loop_closure"}});
  EXPECT_TRUE(std::none_of(without.begin(), without.end(), [](const auto& s) { return s.section == "scan_odometry"; }))
      << "an INI without laser odometry gets no keys for it";
}

TEST(Scans, ThatDeclareAWrongApertureGetTheirOwn) {
  for (const double declared : {kPi / 2, 1.5 * kPi}) {
    auto log = halfALap({SimulatedLaser()}, [](auto& options) { options.laps = 1; });
    each<CObservation2DRangeScan>(log, [&](auto& scan) { scan.aperture = static_cast<float>(declared); });
    const Checked checked(log);
    EXPECT_TRUE(checked.says("problem: 'laser': its scans declare")) << checked.text();
    EXPECT_TRUE(checked.says("better with 180 deg")) << checked.text();
    EXPECT_EQ(checked.proposed("mapper", "sensors"), "place_of_laser");
    EXPECT_EQ(checked.proposed("place_of_laser", "aperture_deg"), "180.0");
    EXPECT_EQ(checked.proposed("place_of_laser", "pose_x_m"), "") << "its place is right";
    EXPECT_FALSE(checked.says("mounted")) << checked.text();
  }
}

TEST(SensorPose, ThatIsMissingIsSaidAndMeasuredByTheMotion) {
  const Checked checked(mounted({0.35, 0.1, 0, 0, 0, 0}, {}));
  EXPECT_TRUE(checked.says("warning: 'laser': its sensor pose is missing")) << checked.text();
  EXPECT_EQ(checked.proposed("mapper", "sensors"), "place_of_laser");
  EXPECT_EQ(checked.proposed("place_of_laser", "label"), "laser");
  EXPECT_NEAR(std::stod(checked.proposed("place_of_laser", "pose_x_m")), 0.35, 0.05);
  EXPECT_NEAR(std::stod(checked.proposed("place_of_laser", "pose_y_m")), 0.1, 0.05);
}

TEST(SensorPose, UpsideDownUnsaidAndWheelsThatTakeLeftForRightAreBothNamed) {
  const CPose3D said(0.2, 0, 0.3, 0, 0, 0);
  auto swapped = halfALap();
  each<CObservationOdometry>(swapped, [](auto& odometry) {
    const auto& p = odometry.odometry;
    odometry.odometry = mrpt::poses::CPose2D(p.x(), -p.y(), -p.phi());
  });
  for (const auto& log : {mounted({0.2, 0, 0.3, 0, 0, kPi}, said), swapped}) {
    const Checked checked(log);
    EXPECT_TRUE(checked.says("problem: 'laser' and 'odometry': where the scans turn left, the odometry turns right"))
        << checked.text();
    EXPECT_TRUE(checked.says("pose_z_m 0.30, pose_yaw_deg 0.0, pose_pitch_deg 0.0, pose_roll_deg 180.0"))
        << checked.text();
    EXPECT_EQ(checked.proposed("mapper", "sensors"), "") << "neither is switched on by a guess";
    EXPECT_EQ(checked.proposed("mapper", "pose_plugins"), "");
  }
}

/// A gyroscope of the base that measures the turns of the odometry times `sign`.
Observations withGyroscope(Observations log, double sign) {
  std::shared_ptr<CObservationOdometry> last;
  Observations all;
  for (const auto& observation : log) {
    all.push_back(observation);
    const auto odometry = std::dynamic_pointer_cast<CObservationOdometry>(observation);
    if (!odometry) continue;
    auto imu = mrpt::obs::CObservationIMU::Create();
    const double seconds = last ? base::secondsBetween(last->timestamp, odometry->timestamp) : 1;
    const double turn = last ? mrpt::math::wrapToPi(odometry->odometry.phi() - last->odometry.phi()) : 0;
    imu->timestamp = odometry->timestamp - base::durationFromSeconds(0.5 * seconds);
    imu->sensorLabel = "imu";
    imu->set(mrpt::obs::IMU_WX, 0);
    imu->set(mrpt::obs::IMU_WY, 0);
    imu->set(mrpt::obs::IMU_WZ, sign * turn / seconds);
    all.push_back(imu);
    last = odometry;
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
  return all;
}

TEST(SensorPose, OfTheWheelsAndTheLaserAGyroscopeTellsWhichIsWrong) {
  const CPose3D said(0.2, 0, 0.3, 0, 0, 0);
  const Checked wheels_are_wrong(withGyroscope(mounted({0.2, 0, 0.3, 0, 0, kPi}, said), -1));
  EXPECT_TRUE(wheels_are_wrong.says("problem: 'odometry': is reversed compared with the scans"))
      << wheels_are_wrong.text();
  EXPECT_EQ(wheels_are_wrong.proposed("mapper", "sensors"), "");

  const Checked checked(withGyroscope(mounted({0.2, 0, 0.3, 0, 0, kPi}, said), 1));
  EXPECT_TRUE(checked.says("problem: 'laser': is mounted upside down, which")) << checked.text();
  EXPECT_EQ(std::abs(std::stod(checked.proposed("place_of_laser", "pose_roll_deg"))), 180);
  EXPECT_EQ(checked.proposed("place_of_laser", "pose_x_m"), "0.20");
  EXPECT_EQ(checked.proposed("mapper", "pose_plugins"), "") << "the odometry is not to blame";
}

TEST(SensorPose, BackwardsUnsaidIsFoundAndProposed) {
  const Checked checked(mounted({-0.2, 0, 0.3, kPi, 0, 0}, {-0.2, 0, 0.3, 0, 0, 0}));
  EXPECT_TRUE(checked.says("problem: 'laser': looks backwards, which")) << checked.text();
  EXPECT_NEAR(std::abs(std::stod(checked.proposed("place_of_laser", "pose_yaw_deg"))), 180, 2);
  EXPECT_NEAR(std::stod(checked.proposed("place_of_laser", "pose_x_m")), -0.2, 0.05);
}

TEST(SensorPose, TurnedUnsaidIsMeasured) {
  const Checked checked(mounted({0.2, 0, 0.3, 0.6, 0, 0}, {0.2, 0, 0.3, 0, 0, 0}));
  EXPECT_NEAR(std::stod(checked.proposed("place_of_laser", "pose_yaw_deg")), 0.6 * 180 / kPi, 2);
}

TEST(SensorPose, ThatIsSaidRightNeedsNothing) {
  for (const auto& pose : {CPose3D(0.2, 0, 0.3, 0, 0, kPi), CPose3D(-0.2, 0.1, 0.3, kPi, 0, 0)}) {
    const Checked checked(mounted(pose, pose));
    EXPECT_EQ(toIni(checked.settings), "") << pose;
    for (const auto& finding : checked.findings) EXPECT_EQ(finding.weight, Weight::note) << finding.text;
  }
}

}  // namespace
}  // namespace omnimapper::check::scans_test
