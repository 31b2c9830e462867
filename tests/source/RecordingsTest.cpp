#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>
#include <omnimapper/testing/Logs.h>

#include <fstream>
#include <set>
#include <sstream>

// Real logs; the other tests of this folder check the same properties on simulated ones.
namespace omnimapper::source::recordings_test {
namespace {

using logs::readAll;

std::uint64_t countOf(const SourceReport& report, const std::string& label, const std::string& class_name) {
  const auto found = report.sensors.find({label, class_name});
  return found == report.sensors.end() ? 0 : found->second.observations;
}

SourceReport reportOf(const std::string& path) {
  RawlogSource source(path);
  while (source.next()) {
  }
  return source.report();
}

constexpr const char* kScan = "mrpt::obs::CObservation2DRangeScan";
constexpr const char* kOdometry = "mrpt::obs::CObservationOdometry";
constexpr const char* kMotion = "omnimapper::obs::CObservationRelativeMotion";

TEST(Recordings, ualHasItsOdometryAndScans) {
  const auto path = testing::sharedData("laser2d/ual.rawlog");
  OMNIMAPPER_NEEDS(path);
  const auto report = reportOf(*path);
  EXPECT_EQ(report.ending, SourceReport::Ending::complete);
  EXPECT_EQ(countOf(report, "ODOMETRY", kOdometry), 15351u);
  EXPECT_EQ(countOf(report, "SICK_FRONT_OBS", kScan), 3318u);
  EXPECT_EQ(report.objects, 18669u);
}

TEST(Recordings, officeHasAScanForEachOfItsFramesAndAMotionForEachActionThatSpansSomething) {
  const auto path = testing::sharedData("laser2d/driving_in_office.rawlog");
  OMNIMAPPER_NEEDS(path);
  const auto report = reportOf(*path);
  EXPECT_EQ(countOf(report, "FLASER", kScan), 1159u);
  EXPECT_EQ(countOf(report, "odometry", kMotion) + report.dropped_actions, 1161u);
  EXPECT_EQ(report.dropped_actions, 1u);
  EXPECT_EQ(report.backwardStamps(), 0u);
}

TEST(Recordings, malagaHasOneMotionForEachFrameButTheFirst) {
  const auto path = testing::mrptDataset("2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog");
  OMNIMAPPER_NEEDS(path);
  const auto report = reportOf(*path);
  EXPECT_EQ(report.objects, 449u);
  EXPECT_EQ(countOf(report, "", kScan), 225u);
  EXPECT_EQ(countOf(report, "odometry", kMotion), 224u);
}

// Actions without stamps: the true motion between the frames around an action is that of the action.
TEST(Recordings, simulatedActionsFitTheTruthBetweenTheFramesAroundThem) {
  const auto path = testing::mrptDataset("graphslam-engine-demos/action_observations_map/simul.rawlog");
  OMNIMAPPER_NEEDS(path);
  // One line for each frame, and one more: stamp x y yaw.
  std::vector<std::pair<std::string, mrpt::poses::CPose2D>> truth;
  std::ifstream file(*path + ".GT.txt");
  std::string stamp;
  for (double x, y, yaw; file >> stamp >> x >> y >> yaw;) truth.emplace_back(stamp, mrpt::poses::CPose2D(x, y, yaw));
  RawlogSource source(*path);
  const auto motions = logs::motionsOf(readAll(source));
  ASSERT_EQ(motions.size(), 1732u);
  ASSERT_EQ(truth.size(), 1734u);
  double squares = 0, travel = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto& [begin, from] = truth[i];
    const auto& [end, to] = truth[i + 1];
    ASSERT_NEAR(base::secondsBetween(base::parseUnix(begin), motions[i]->begin), 0, 2e-6);
    ASSERT_NEAR(base::secondsBetween(base::parseUnix(end), motions[i]->timestamp), 0, 2e-6);
    const auto difference = (to - from) - mrpt::poses::CPose2D(motions[i]->begin_from_end);
    squares += difference.norm() * difference.norm();
    travel += (to - from).norm();
  }
  const double rms = std::sqrt(squares / 1732);
  EXPECT_LT(rms, 0.05) << "one frame off it is 0.12 and more";
  EXPECT_GT(travel / 1732, 0.05) << "the robot does move";
}

}  // namespace
}  // namespace omnimapper::source::recordings_test
