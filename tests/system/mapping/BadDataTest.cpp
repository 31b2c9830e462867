// Whole logs of bad data, each mapped with ini/laser2d.ini and laser odometry: the map is close to the truth all the
// same, or the run gives the reason why it is not.
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <functional>

#include "../MapFolder.h"
#include "../Rawlogs.h"

namespace {

using namespace runs;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLaser;
using omnimapper::testing::SimulatedLogOptions;
using rawlogs::Observations;

constexpr double kPi = 3.14159265358979323846;

/// A fixture with two laps of the ring of rooms.
class BadData : public ::testing::Test {
 protected:
  static SimulatedLogOptions twoLaps() {
    SimulatedLogOptions options;
    options.laps = 2;
    return options;
  }
  explicit BadData(const SimulatedLogOptions& options = twoLaps()) { simulate(options); }
  void simulate(const SimulatedLogOptions& options) {
    log_ = std::make_unique<SimulatedLog>(options);
    observations_ = log_->observations();
  }
  double secondsOf(const mrpt::obs::CObservation& observation) const {
    return omnimapper::base::secondsBetween(log_->begin(), observation.timestamp);
  }
  /// Changes the observations of a class between seconds `from` and `to` of the log.
  template <class Class>
  void each(double from, double to, const std::function<void(Class&)>& change) {
    for (const auto& observation : observations_) {
      auto* found = dynamic_cast<Class*>(observation.get());
      if (found && secondsOf(*found) >= from && secondsOf(*found) < to) change(*found);
    }
  }
  template <class Class>
  void each(const std::function<void(Class&)>& change) {
    each<Class>(0, 1e9, change);
  }
  Ended mapThem(const Texts& more = {}) {
    writeFile(scratch_ / "bad.rawlog", rawlogs::bytesOf(observations_).text);
    return map({scratch_ / "bad.rawlog"}, folder_, more);
  }
  /// Maps the observations and expects exit code 0 and a trajectory that is close to the truth.
  void expectMap(const Texts& words = {}, double largest_error = 0.15) {
    const auto ended = mapThem();
    ASSERT_TRUE(endedWith(ExitCode::ok, ended, words));
    const auto trajectory = loadTrajectory(folder_);
    EXPECT_GT(trajectory.size(), 0.95 * scanStamps(*log_).size());
    const double error = errorAgainst(*log_, trajectory);
    RecordProperty("ate_m", std::to_string(error));
    EXPECT_LT(error, largest_error) << ended.err;
  }
  static void blind(CObservation2DRangeScan& scan, float range, bool valid) {
    for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
      scan.setScanRange(i, range);
      scan.setScanRangeValidity(i, valid);
    }
  }
  void mount(const std::vector<CPose3D>& base_from_sensors) {
    auto options = twoLaps();
    options.lasers.clear();
    for (const auto& pose : base_from_sensors) {
      SimulatedLaser laser;
      if (!options.lasers.empty()) laser.label = "laser" + std::to_string(options.lasers.size() + 1);
      laser.phase += 0.037 * static_cast<double>(options.lasers.size());
      laser.base_from_sensor = pose;
      options.lasers.push_back(laser);
    }
    simulate(options);
  }

  ScratchFolder scratch_;
  std::string folder_ = scratch_ / "map";
  std::unique_ptr<SimulatedLog> log_;
  Observations observations_;
};

TEST_F(BadData, ScansOfZerosForAWhileAreBridged) {
  each<CObservation2DRangeScan>(20, 26, [](auto& scan) { blind(scan, 0, true); });
  expectMap();
}

TEST_F(BadData, ScansOfMaximumRangeForAWhileAreBridged) {
  each<CObservation2DRangeScan>(20, 23, [](auto& scan) { blind(scan, scan.maxRange, false); });
  each<CObservation2DRangeScan>(40, 43, [](auto& scan) { blind(scan, scan.maxRange, true); });
  expectMap();
}

TEST_F(BadData, ScansOfNothingButZerosAreSaidToMeasureNothing) {
  each<CObservation2DRangeScan>([](auto& scan) { blind(scan, 0, true); });
  EXPECT_TRUE(endedWith(ExitCode::ok, mapThem(), {"warning: nothing was measured"}));
  EXPECT_EQ(stampsOf(loadTrajectory(folder_)), scanStamps(*log_)) << "the poses of the odometry are kept";
}

TEST_F(BadData, ScansOfNothingButMaximumRangeAreSaidToMeasureNothing) {
  each<CObservation2DRangeScan>([](auto& scan) { blind(scan, scan.maxRange, true); });
  EXPECT_TRUE(endedWith(ExitCode::ok, mapThem(), {"warning: nothing was measured"}));
}

TEST_F(BadData, ALaserUpsideDownIsMappedWhereItsPoseSaysSo) {
  mount({CPose3D(0.2, 0.05, 0.3, 0, 0, kPi)});
  expectMap();
}

TEST_F(BadData, ALaserUpsideDownIsMappedWhereTheIniSaysSo) {
  mount({CPose3D(0.2, 0.05, 0.3, 0, 0, kPi)});
  each<CObservation2DRangeScan>([](auto& scan) { scan.sensorPose = CPose3D(); });
  const auto ended =
      mapThem({"--set", "mapper.sensors=front", "--set", "front.label=laser", "--set", "front.pose_x_m=0.2", "--set",
               "front.pose_y_m=0.05", "--set", "front.pose_z_m=0.3", "--set", "front.pose_roll_deg=180"});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_LT(errorAgainst(*log_, loadTrajectory(folder_)), 0.15);
}

TEST_F(BadData, ALaserThatLooksBackwardsIsMapped) {
  mount({CPose3D(-0.25, 0, 0.3, kPi, 0, 0)});
  expectMap();
}

TEST_F(BadData, ALaserUpsideDownThatLooksAskewIsMapped) {
  mount({CPose3D(0.1, 0.2, 0.3, 2.2, 0, kPi)});
  expectMap();
}

TEST_F(BadData, TwoLasersAtOnceAreMapped) {
  mount({CPose3D(0.2, 0, 0.3, 0, 0, 0), CPose3D(-0.25, 0, 0.4, kPi, 0, kPi)});
  expectMap();
}

TEST_F(BadData, OdometryThatIsAbsentIsMadeUpForByTheScans) {
  observations_.erase(std::remove_if(observations_.begin(), observations_.end(),
                                     [](const auto& o) { return o->sensorLabel == "odometry"; }),
                      observations_.end());
  expectMap();
}

TEST_F(BadData, OdometryThatIsFrozenIsMadeUpForByTheScans) {
  each<CObservationOdometry>([](auto& odometry) { odometry.odometry = CPose2D(); });
  expectMap();
}

TEST_F(BadData, OdometryThatFreezesForAWhileIsMadeUpForByTheScans) {
  CPose2D held;
  each<CObservationOdometry>(0, 30, [&](auto& odometry) { held = odometry.odometry; });
  each<CObservationOdometry>(30, 38, [&](auto& odometry) { odometry.odometry = held; });
  expectMap();
}

TEST_F(BadData, OdometryThatRunsBackwardsIsMadeUpForByTheScans) {
  // The result of encoders with swapped signs.
  each<CObservationOdometry>([](auto& odometry) {
    const auto& p = odometry.odometry;
    odometry.odometry = CPose2D(-p.x(), p.y(), -p.phi());
  });
  expectMap();
}

TEST_F(BadData, OdometryThatJumpsIsMadeUpForByTheScans) {
  each<CObservationOdometry>(33, 1e9, [](auto& odometry) { odometry.odometry = CPose2D(3, 4, 0) + odometry.odometry; });
  expectMap();
}

TEST_F(BadData, OdometryThatJumpsOnTheSpotIsMadeUpForByTheScans) {
  // As after a kick: the odometry continues from another position and another heading.
  each<CObservationOdometry>(50, 1e9, [](auto& odometry) { odometry.odometry = CPose2D(5, 0, 1) + odometry.odometry; });
  expectMap();
}

}  // namespace
