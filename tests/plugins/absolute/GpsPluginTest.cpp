#include <gtest/gtest.h>
#include <omnimapper/geometry/Angle.h>
#include <omnimapper/testing/HandMadeRun.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <cmath>

#include "absolute/GpsPlugin.h"

namespace omnimapper::plugins::gps_plugin_test {
namespace {

using mrpt::obs::CObservationGPS;
using mrpt::poses::CPose3D;

const std::string kGpsIni = R"(
[mapper]
pose_plugins        = odometry
measurement_plugins = gps
[odometry]
class = OdometryPlugin
[gps]
class = GpsPlugin
)";

// A drive around the ring with an RTK receiver and no laser.
testing::SimulatedLogOptions ringWithGps(double heading = 0.7) {
  testing::SimulatedLogOptions options;
  options.lasers.clear();
  options.gps.on = true;
  options.gps.enu_from_map = CPose3D(40, -25, 0, heading, 0, 0);
  return options;
}

mrpt::obs::gnss::Message_NMEA_GGA& gga(mrpt::obs::CObservation& observation) {
  return dynamic_cast<CObservationGPS&>(observation).getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>();
}

std::vector<CObservationGPS::Ptr> fixes(const std::vector<mrpt::obs::CObservation::Ptr>& log) {
  std::vector<CObservationGPS::Ptr> found;
  for (const auto& observation : log) {
    if (auto fix = std::dynamic_pointer_cast<CObservationGPS>(observation)) found.push_back(fix);
  }
  return found;
}

// map_from_enu as estimated by a run.
CPose3D foundAlignment(const mapper::View& view) {
  const auto& frames = view.map.key_frames;
  for (const auto& [id, record] : view.graph.variables()) {
    if (std::none_of(frames.begin(), frames.end(), [id = id](const auto& frame) { return frame.pose == id; })) {
      return mapper::poseOf(view.graph, id);
    }
  }
  ADD_FAILURE() << "no variable beside the poses";
  return {};
}

// Root mean square distance [m] of the key frames from the truth on the earth, independent of the frame of the map. The
// plugin's origin is the first fix.
double errorOnEarth(const mapper::View& view, const testing::SimulatedLog& log,
                    const testing::SimulatedLogOptions& options) {
  const auto& gps = options.gps;
  const auto& frames = view.map.key_frames;
  const auto enu_from_base = [&](base::Stamp stamp) { return gps.enu_from_map + CPose3D(log.truthAt(stamp)); };
  const auto origin_in_enu = (enu_from_base(frames.front().stamp) + gps.antenna).translation();
  const CPose3D found_from_map = -foundAlignment(view);
  double sum = 0;
  for (const auto& frame : frames) {
    const auto truth = enu_from_base(frame.stamp).translation() - origin_in_enu;
    const auto error = (found_from_map + frame.map_from_base).translation() - truth;
    sum += error.x * error.x + error.y * error.y;
  }
  return std::sqrt(sum / static_cast<double>(frames.size()));
}

class GpsHeadings : public ::testing::TestWithParam<double> {};

TEST_P(GpsHeadings, FindsTheHeadingOfTheMapAndBoundsTheDriftOfOdometry) {
  const auto options = ringWithGps(GetParam());
  const testing::SimulatedLog log(options);
  const auto engine = testing::makeEngine(kGpsIni);
  testing::run(*engine, log.observations());
  // The map's heading is that of the base at the start, which the first links hold to a degree or so.
  EXPECT_NEAR(geometry::wrapToPi(foundAlignment(engine->view()).yaw() + GetParam()), 0, 0.03);
  EXPECT_LT(errorOnEarth(engine->view(), log, options), 0.08);
}

TEST_P(GpsHeadings, AMapThatIsEastNorthUpLiesThereFromAnyHeading) {
  const auto options = ringWithGps(GetParam());
  const testing::SimulatedLog log(options);
  const auto engine = testing::makeEngine(kGpsIni, {"gps.map_is_enu=true", "gps.origin_latitude=36.7",
                                                    "gps.origin_longitude=-4.5", "gps.origin_altitude_m=50"});
  testing::run(*engine, log.observations());
  const auto& frames = engine->view().map.key_frames;
  ASSERT_GT(frames.size(), 40U);
  double sum = 0;
  for (const auto& frame : frames) {
    const CPose3D error = frame.map_from_base - (options.gps.enu_from_map + CPose3D(log.truthAt(frame.stamp)));
    sum += error.translation().sqrNorm();
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(frames.size())), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Headings, GpsHeadings, ::testing::Values(0.0, 0.7, -1.6, 3.0));

TEST(GpsPlugin, TheLeverArmOfTheAntennaCounts) {
  auto options = ringWithGps();
  options.gps.antenna = CPose3D(0, 0.8, 1, 0, 0, 0);  // beside the robot: a tour seen from there is a longer one
  options.gps.sigma = 0.005;
  const testing::SimulatedLog log(options);
  double errors[2];
  for (const bool lever_given : {true, false}) {
    auto observations = log.observations();
    if (!lever_given) {
      for (const auto& fix : fixes(observations)) fix->sensorPose = CPose3D();
    }
    const auto engine = testing::makeEngine(kGpsIni);
    testing::run(*engine, observations);
    errors[lever_given] = errorOnEarth(engine->view(), log, options);
  }
  EXPECT_LT(errors[true], 0.05);
  EXPECT_GT(errors[false], 0.5);
}

// The antenna is above the origin of the base, so nothing determines the heading of the base.
TEST(GpsPlugin, MapsWithoutOdometryWithTheMapsXToTheEast) {
  auto options = ringWithGps();
  options.gps.antenna = CPose3D(0, 0, 1, 0, 0, 0);
  const testing::SimulatedLog log(options);
  const auto engine =
      testing::makeEngine(kGpsIni + "[no_motion]\nclass = NoMotionPlugin\n", {"mapper.pose_plugins=no_motion"});
  testing::run(*engine, log.observations());
  EXPECT_GT(engine->view().map.key_frames.size(), 20U);
  EXPECT_NEAR(foundAlignment(engine->view()).yaw(), 0, 0.2);
  EXPECT_LT(errorOnEarth(engine->view(), log, options), 0.1);
}

TEST(GpsPlugin, NoiseOfARobotAtRestDeterminesNoHeading) {
  const auto engine =
      testing::makeEngine(kGpsIni + "[no_motion]\nclass = NoMotionPlugin\n",
                          {"mapper.pose_plugins=no_motion", "trigger.every_observation=true", "gps.sigma_m=3"});
  auto options = ringWithGps();
  const auto first = fixes(testing::SimulatedLog(options).observations()).front();
  testing::Dice dice(5);
  std::vector<mrpt::obs::CObservation::Ptr> log;
  for (int i = 0; i < 50; ++i) {
    auto fix = std::make_shared<CObservationGPS>(*first);
    fix->timestamp = first->timestamp + base::durationFromSeconds(i);
    gga(*fix).fields.fix_quality = 1;
    gga(*fix).fields.latitude_degrees += dice.normal(3 / 111'000.0);
    if (i == 7) gga(*fix).fields.latitude_degrees += 100 / 111'000.0;  // one is far off
    log.push_back(fix);
  }
  testing::run(*engine, log);
  EXPECT_EQ(engine->view().graph.factors().size(), engine->view().map.key_frames.size() - 1) << "only links";
}

TEST(GpsPlugin, AMapInSpaceFindsHeightAndTiltToo) {
  auto options = ringWithGps();
  options.gps.enu_from_map = CPose3D(40, -25, 0, 0.7, 0.02, -0.03);
  const testing::SimulatedLog log(options);
  const auto engine = testing::makeEngine(kGpsIni, {"mapper.motion=spatial"});
  testing::run(*engine, log.observations());
  EXPECT_LT(errorOnEarth(engine->view(), log, options), 0.1);
  const CPose3D found = -foundAlignment(engine->view());
  EXPECT_NEAR(found.pitch(), 0.02, 0.02);
  EXPECT_NEAR(found.roll(), -0.03, 0.02);
}

TEST(GpsPlugin, ATenthOfOutlierFixesDistortsNothing) {
  const auto options = ringWithGps();
  const testing::SimulatedLog log(options);
  auto observations = log.observations();
  const auto all = fixes(observations);
  for (std::size_t i = 15; i < all.size(); i += 10) gga(*all[i]).fields.latitude_degrees += 30.0 / 111'000;  // 30 m
  const auto engine = testing::makeEngine(kGpsIni);
  testing::run(*engine, observations);
  EXPECT_LT(errorOnEarth(engine->view(), log, options), 0.08);
}

TEST(GpsPlugin, BadFixesAreRefusedWithTheReason) {
  const testing::SimulatedLog log(ringWithGps());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Edit = std::function<void(mrpt::obs::gnss::Message_NMEA_GGA::content_t&)>;
  const std::vector<std::pair<std::string, Edit>> cases{
      {"no fix", [](auto& fields) { fields.fix_quality = 0; }},
      {"poor satellite geometry", [](auto& fields) { fields.HDOP = 30; }},
      {"poor satellite geometry", [=](auto& fields) { fields.HDOP = static_cast<float>(nan); }},
      {"not finite", [=](auto& fields) { fields.latitude_degrees = nan; }},
      {"not finite", [=](auto& fields) { fields.altitude_meters = nan; }},
  };
  for (const auto& [reason, edit] : cases) {
    GpsPlugin plugin({}, {});
    testing::HandMadeRun run;
    const auto fix = fixes(log.observations()).front();
    edit(gga(*fix).fields);
    const auto batch = plugin.measure(run.addFrame({}), {*fix, nullptr}, run.view());
    EXPECT_TRUE(batch.addedFactors().empty());
    ASSERT_EQ(batch.decisions().size(), 1U);
    EXPECT_FALSE(batch.decisions().front().accepted);
    EXPECT_EQ(batch.decisions().front().reason, reason);
  }
}

TEST(GpsPlugin, FixesWaitUntilTheySpreadAndThenAllCount) {
  const auto options = ringWithGps();
  const testing::SimulatedLog log(options);
  GpsOptions gps;
  gps.min_spread = 3;
  GpsPlugin plugin(gps, {});
  testing::HandMadeRun run;
  const auto all = fixes(log.observations());
  std::size_t waiting = 0;
  for (const auto& fix : all) {
    const auto& frame = run.addFrame(CPose3D(log.truthAt(fix->timestamp)));
    const auto batch = plugin.measure(frame, {*fix, nullptr}, run.view());
    if (batch.addedFactors().empty()) {
      EXPECT_TRUE(batch.addedVariables().empty());
      ++waiting;
      continue;
    }
    EXPECT_EQ(batch.addedFactors().size(), waiting + 1);
    EXPECT_EQ(batch.addedVariables().size(), 1U);
    const double distance = log.truthAt(fix->timestamp).norm();
    EXPECT_NEAR(distance, 3, 0.8) << "0.7 m a second";
    return;
  }
  FAIL() << "never enough";
}

TEST(GpsPlugin, TheQualityOfAFixIsItsSigma) {
  GpsOptions options;
  options.map_is_enu = true;
  options.origin_latitude = 36.7;
  options.origin_longitude = -4.5;
  const std::vector<std::tuple<int, float, double>> cases{{4, 0.9F, options.sigma_rtk},
                                                          {5, 0.9F, options.sigma_rtk_float},
                                                          {1, 0.9F, options.sigma},
                                                          {1, 2.5F, 2.5 * options.sigma}};
  for (const auto& [quality, hdop, sigma] : cases) {
    GpsPlugin plugin(options, {});
    testing::HandMadeRun run;
    const auto fix = fixes(testing::SimulatedLog(ringWithGps()).observations()).front();
    gga(*fix).fields.fix_quality = static_cast<std::uint8_t>(quality);
    gga(*fix).fields.HDOP = hdop;
    const auto batch = plugin.measure(run.addFrame({}), {*fix, nullptr}, run.view());
    ASSERT_EQ(batch.addedFactors().size(), 1U);
    EXPECT_NEAR(std::sqrt(batch.addedFactors().front().noise.covariance()(0, 0)), sigma, 1e-6) << quality;
  }
}

}  // namespace
}  // namespace omnimapper::plugins::gps_plugin_test
