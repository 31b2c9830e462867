#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/testing/Fixtures.h>

#include "ros_log/RosLog.h"

// Logs that programs of others wrote, with the scripts beside them.
namespace omnimapper::ros::others_writers_test {
namespace {

using mrpt::obs::CObservation2DRangeScan;

std::vector<mrpt::obs::CObservation::Ptr> read(const std::string& name) {
  RosLog log(testing::sourceFile("tests/plugins/ros_log/logs/" + name));
  std::vector<mrpt::obs::CObservation::Ptr> all;
  while (const auto observation = log.next()) all.push_back(observation);
  EXPECT_EQ(log.report().ending, source::SourceReport::Ending::complete) << log.report().message;
  return all;
}

template <class Class>
std::vector<std::shared_ptr<Class>> withLabel(const std::vector<mrpt::obs::CObservation::Ptr>& all,
                                              const std::string& label) {
  std::vector<std::shared_ptr<Class>> found;
  for (const auto& one : all)
    if (one->sensorLabel == label) found.push_back(std::dynamic_pointer_cast<Class>(one));
  return found;
}

TEST(BagOfPython3Rosbag, isReadWithAllItsSensors) {
  for (const char* name : {"python3_rosbag_bz2.bag", "python3_rosbag_lz4.bag"}) {
    const auto all = read(name);
    EXPECT_EQ(all.size(), 20u) << name;
    const auto scans = withLabel<CObservation2DRangeScan>(all, "scan");
    ASSERT_EQ(scans.size(), 4u);
    EXPECT_EQ(scans[3]->getScanRange(4), 5);
    EXPECT_NEAR(scans[3]->sensorPose.x(), 0.2, 1e-9);
    const auto echoes = withLabel<CObservation2DRangeScan>(all, "echoes");
    ASSERT_EQ(echoes.size(), 4u);
    EXPECT_EQ(echoes[0]->getScanRange(0), 1.5F) << "the first echo";
    EXPECT_EQ(echoes[0]->getScanRange(1), 30) << "no echo";
    const auto odometry = withLabel<mrpt::obs::CObservationOdometry>(all, "odom");
    ASSERT_EQ(odometry.size(), 4u);
    EXPECT_EQ(odometry[3]->odometry.x(), 3);
    const auto imu = withLabel<mrpt::obs::CObservationIMU>(all, "imu");
    ASSERT_EQ(imu.size(), 4u);
    EXPECT_EQ(imu[0]->get(mrpt::obs::IMU_Z_ACC), 9.81);
    const auto fixes = withLabel<mrpt::obs::CObservationGPS>(all, "fix");
    ASSERT_EQ(fixes.size(), 4u);
    // A copy, because the fields of MRPT are packed.
    const double latitude = fixes[0]->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields.latitude_degrees;
    EXPECT_EQ(latitude, 48.5);
  }
}

TEST(McapOfNpm, isRead) {
  const auto scans = withLabel<CObservation2DRangeScan>(read("mcap_core.mcap"), "scan");
  ASSERT_EQ(scans.size(), 4u);
  EXPECT_NEAR(scans[0]->aperture, 2, 1e-6);
  EXPECT_EQ(scans[2]->getScanRange(0), 4);
}

}  // namespace
}  // namespace omnimapper::ros::others_writers_test
