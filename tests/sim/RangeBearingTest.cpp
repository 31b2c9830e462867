#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/base/Error.h>

#include <nlohmann/json.hpp>

#include "SensorRun.h"
#include "SmallWorlds.h"

namespace range_bearing_test {
namespace {

using namespace omnimapper;
using namespace small_worlds;
using Bearings = mrpt::obs::CObservationBearingRange;

const std::string exact = "class = RangeBearing\nsigma_range_m = 0\nsigma_deg = 0\nz_m = 1\n";

// Five points around (1, 2), of which one is behind the box and one behind the sensor, and a marker on the east wall.
sim::World landmarks() {
  sim::World world = oneRoom(6, 4);
  world.point_landmarks = {{"p0", 10, {3, 2, 1}, ""},
                           {"p1", 11, {4, 3, 1.5}, ""},
                           {"hidden", 12, {4.5, 1, 1}, ""},
                           {"behind", 13, {0.2, 2, 1}, ""},
                           {"far", 14, {30, 2, 1}, ""}};
  addBox(world, "box", {2.5, 1.2}, {3, 1.6}, 2);
  addQuad(world, "marker", sim::SurfaceKind::marker, {-0.1, -0.1, 0}, {0.2, 0, 0}, {0, 0.2, 0});
  // Faces out of the east wall, towards -x.
  world.bodies.back().track = sim::Track(
      geometry::Se3{Eigen::Quaterniond(Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitY())), {5.99, 2.5, 1.2}});
  world.markers.push_back({"marker", 7, 0.2});
  return world;
}

TEST(RangeBearing, measurementsGoBackToTheirLandmarks) {
  const SensorRun run(landmarks(), sim::Track(at(1, 2, 0, 0.1)), exact);
  const auto seen = run.measure<Bearings>(0);
  const std::vector<std::string> names = nlohmann::json::parse(run.truth(0))["landmarks"];
  ASSERT_EQ(seen->sensedData.size(), names.size());
  EXPECT_EQ(std::multiset<std::string>(names.begin(), names.end()), (std::multiset<std::string>{"marker", "p0", "p1"}));
  const std::map<std::string, std::pair<int, Eigen::Vector3d>> truth{
      {"p0", {10, {3, 2, 1}}}, {"p1", {11, {4, 3, 1.5}}}, {"marker", {7, {5.99, 2.5, 1.2}}}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& one = seen->sensedData[i];
    const double range = static_cast<double>(one.range), yaw = static_cast<double>(one.yaw) + 0.1,
                 pitch = static_cast<double>(one.pitch);
    const Eigen::Vector3d in_map(1 + range * std::cos(yaw) * std::cos(pitch),
                                 2 + range * std::sin(yaw) * std::cos(pitch), 1 - range * std::sin(pitch));
    EXPECT_LT((in_map - truth.at(names[i]).second).norm(), 1e-5) << names[i];
    EXPECT_EQ(one.landmarkID, truth.at(names[i]).first);
  }
}

TEST(RangeBearing, whatIsHiddenIsMeasuredOnlyIfNothingHides) {
  const SensorRun run(landmarks(), sim::Track(at(1, 2)),
                      exact + "occlusion = false\nknown_ids = false\nfov_yaw_deg = 360\nmarkers = false");
  const auto seen = run.measure<Bearings>(0);
  EXPECT_EQ(seen->sensedData.size(), 4u);
  for (const auto& one : seen->sensedData) EXPECT_EQ(one.landmarkID, -1);
}

TEST(RangeBearing, landmarksOfOneIdAreRefusedWhereIdsAreKnown) {
  sim::World world = oneRoom(6, 6);
  world.point_landmarks = {{"left", 7, {1, 2, 1}, ""}, {"right", 7, {1, -2, 1}, ""}};
  const sim::Track still(geometry::Se3{});
  EXPECT_NO_THROW(SensorRun(world, still, exact + "known_ids = false\n"));
  try {
    SensorRun(world, still, exact);
    FAIL() << "not refused";
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("test.ini: [sensor] points, markers: left and right"), std::string::npos)
        << error.what();
  }
}

TEST(RangeBearing, planarOnesHaveNoPitchAndHorizontalRange) {
  const SensorRun run(landmarks(), sim::Track(at(4, 1)),
                      exact + "planar = true\nyaw_deg = 90\nmarkers = false\nfov_yaw_deg = 20");
  const auto seen = run.measure<Bearings>(0);
  ASSERT_EQ(seen->sensedData.size(), 1u);
  EXPECT_EQ(seen->sensedData[0].pitch, 0);
  EXPECT_NEAR(seen->sensedData[0].range, 2, 1e-6);
}

TEST(RangeBearing, nothingSeenIsNoObservation) {
  const SensorRun run(landmarks(), sim::Track(at(1, 2)), exact + "max_range_m = 0.5");
  EXPECT_FALSE(run.sensor().measure(0).observation);
}

TEST(RangeBearing, noiseMissesAndFalseAlarmsComeAtTheirRates) {
  const SensorRun run(landmarks(), sim::Track(at(1, 2)),
                      "class = RangeBearing\nz_m = 1\nmarkers = false\nsigma_range_m = 0.1\nsigma_deg = 2\nmissed = "
                      "0.25\nfalse_alarms = 0.5\nrate_hz = 100",
                      40);
  int reported = 0, ghosts = 0, first_is_p0 = 0, both = 0;
  double range = 0, yaw = 0;
  const int count = run.sensor().count();
  for (int k = 0; k < count; ++k) {
    const auto seen = run.measure<Bearings>(k);
    if (!seen) continue;
    const std::vector<std::string> names = nlohmann::json::parse(run.truth(k))["landmarks"];
    for (std::size_t i = 0; i < names.size(); ++i) {
      ghosts += names[i].empty();
      reported += !names[i].empty();
      if (names[i] != "p0") continue;
      range += std::pow(static_cast<double>(seen->sensedData[i].range) - 2, 2) / (0.75 * count);
      yaw += std::pow(static_cast<double>(seen->sensedData[i].yaw), 2) / (0.75 * count);
    }
    if (names.size() == 2 && !names[0].empty() && !names[1].empty()) ++both, first_is_p0 += names[0] == "p0";
  }
  EXPECT_NEAR(reported, 1.5 * count, 4 * std::sqrt(2 * 0.25 * 0.75 * count));
  EXPECT_NEAR(ghosts, 0.5 * count, 4 * std::sqrt(0.5 * count));
  EXPECT_NEAR(range, 0.01, 0.01 * 0.12);
  EXPECT_NEAR(std::sqrt(yaw), 2 * M_PI / 180, 2 * M_PI / 180 * 0.06);
  EXPECT_NEAR(first_is_p0, 0.5 * both, 4 * std::sqrt(0.25 * both));
}

}  // namespace
}  // namespace range_bearing_test
