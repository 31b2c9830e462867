#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace omnimapper::testing::simulated_log_test {
namespace {

using mrpt::obs::CObservation2DRangeScan;

std::string bytesOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(SimulatedLog, TheSameOptionsGiveTheSameBitsAndAnotherSeedDoesNot) {
  SimulatedLogOptions options;
  options.laps = 0.1;
  options.gps.on = options.tracker.on = true;
  const ScratchFolder folder;
  SimulatedLog(options).writeRawlog(folder / "a.rawlog");
  SimulatedLog(options).writeRawlog(folder / "b.rawlog");
  options.seed = 2;
  SimulatedLog(options).writeRawlog(folder / "c.rawlog");
  EXPECT_TRUE(bytesOf(folder / "a.rawlog") == bytesOf(folder / "b.rawlog"));
  EXPECT_FALSE(bytesOf(folder / "a.rawlog") == bytesOf(folder / "c.rawlog"));
}

TEST(SimulatedLog, TheTourIsSmoothClosedAndClearOfTheWalls) {
  for (const auto place : {SimulatedLogOptions::Place::ring, SimulatedLogOptions::Place::box}) {
    SimulatedLogOptions options;
    options.place = place;
    const SimulatedLog log(options);
    EXPECT_LT(log.truthAt(log.end()).norm(), 1e-6);
    EXPECT_NEAR(std::remainder(log.truthAt(log.end()).phi(), 2 * M_PI), 0, 1e-6);
    const auto step = base::durationFromSeconds(0.02);
    double nearest = 1e9;
    for (auto stamp = log.begin(); stamp + step < log.end(); stamp += step) {
      const auto motion = log.truthAt(stamp + step) - log.truthAt(stamp);
      EXPECT_LT(motion.norm(), 0.02 * options.speed + 1e-6);
      EXPECT_LT(std::abs(motion.phi()), 0.02 * 1.1) << "about a radian a second at most";
      const auto pose = log.truthAt(stamp);
      for (int i = 0; i < 16; ++i) {
        const double angle = i * M_PI / 8;
        nearest =
            std::min(nearest, log.plan().distanceToWall({pose.x(), pose.y()}, {std::cos(angle), std::sin(angle)}));
      }
    }
    EXPECT_GT(nearest, 0.4);
  }
}

TEST(SimulatedLog, ScansOfAnUprightRoomAreWhereTheWallsAre) {
  SimulatedLogOptions options;
  options.place = SimulatedLogOptions::Place::box;
  options.laps = 0.2;
  options.lasers[0].sigma = 0;
  options.lasers[0].base_from_sensor = mrpt::poses::CPose3D();
  const auto observations = SimulatedLog(options).observations();
  for (const auto& observation : observations) {
    const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(observation.get());
    if (!scan) continue;
    // At rest at the origin, 1.5 m from the wall on the right, which the first beam hits; the middle beam points along
    // x.
    EXPECT_NEAR(scan->getScanRange(0), 1.5, 1e-4);
    EXPECT_NEAR(scan->getScanRange(90), 4, 1e-4);
    break;
  }
  for (std::size_t i = 1; i < observations.size(); ++i) {
    EXPECT_LE(observations[i - 1]->timestamp, observations[i]->timestamp);
  }
}

}  // namespace
}  // namespace omnimapper::testing::simulated_log_test
