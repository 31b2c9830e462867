#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/source/CarmenLog.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>
#include <set>
#include <sstream>

#include "Logs.h"

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

// Stamps of the scans, as the log's text has them, to the microsecond.
std::multiset<std::string> scanStampsOf(CarmenLog& log) {
  std::multiset<std::string> stamps;
  while (const auto observation = log.next())
    if (observation->sensorLabel == "FLASER") stamps.insert(base::formatUnix(observation->timestamp, 6));
  return stamps;
}

// The first `columns` fields of each line that is no comment.
std::set<std::string> stampsIn(const std::string& path, int columns) {
  std::set<std::string> stamps;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    std::string stamp;
    for (int i = 0; i < columns && fields >> stamp; ++i) stamps.insert(stamp);
  }
  return stamps;
}

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

TEST(Recordings, acesHasAllItsScansWithTheStampsOfTheRelations) {
  const auto path = testing::sharedData("laser2d/aces.clf.bz2");
  const auto relations = testing::sharedData("laser2d/aces.relations");
  OMNIMAPPER_NEEDS(path && relations);
  CarmenLog log(*path);
  const auto stamps = scanStampsOf(log);
  EXPECT_EQ(stamps.size(), 7374u);
  EXPECT_EQ(log.report().ending, SourceReport::Ending::complete);
  EXPECT_EQ(log.odometry(), CarmenOdometry::lines);
  EXPECT_EQ(countOf(log.report(), "ODOM", kOdometry), 7375u);
  EXPECT_EQ(countOf(log.report(), "FLASER_ODOM", kOdometry), 7374u);
  EXPECT_EQ(log.report().repaired_stamps, 1u) << "two ODOM lines of one stamp";
  const auto wanted = stampsIn(*relations, 2);
  EXPECT_GT(wanted.size(), 1000u);
  for (const auto& stamp : wanted) EXPECT_EQ(stamps.count(stamp), 1u) << stamp;
}

TEST(Recordings, intelHasAllItsScansWithTheRepairedStampsOfTheReference) {
  const auto path = testing::sharedData("laser2d/intel.clf.bz2");
  const auto reference = testing::sharedData("laser2d/intel.reference.tum");
  OMNIMAPPER_NEEDS(path && reference);
  CarmenLog log(*path);
  const auto stamps = scanStampsOf(log);
  EXPECT_EQ(stamps.size(), 13631u);
  EXPECT_EQ(log.odometry(), CarmenOdometry::scans);
  EXPECT_EQ(countOf(log.report(), "ODOM", kOdometry), 13631u);
  // 631 stamps are earlier than the one before; the stamps after each are replaced, too, until the clock has caught up.
  EXPECT_EQ(log.report().repaired_stamps, 3076u);
  for (const auto& stamp : stampsIn(*reference, 1)) EXPECT_EQ(stamps.count(stamp), 1u) << stamp;
}

}  // namespace
}  // namespace omnimapper::source::recordings_test
