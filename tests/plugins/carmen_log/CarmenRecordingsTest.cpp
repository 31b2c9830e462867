#include <omnimapper/testing/Fixtures.h>

#include <fstream>
#include <set>
#include <sstream>

#include "carmen_log/CarmenLog.h"

// Real logs; CarmenLogTest checks the same properties on small ones.
namespace omnimapper::source::carmen_recordings_test {
namespace {

std::uint64_t countOf(const SourceReport& report, const std::string& label, const std::string& class_name) {
  const auto found = report.sensors.find({label, class_name});
  return found == report.sensors.end() ? 0 : found->second.observations;
}

constexpr const char* kOdometry = "mrpt::obs::CObservationOdometry";

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

TEST(CarmenRecordings, acesHasAllItsScansWithTheStampsOfTheRelations) {
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

TEST(CarmenRecordings, intelHasAllItsScansWithTheRepairedStampsOfTheReference) {
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
}  // namespace omnimapper::source::carmen_recordings_test
