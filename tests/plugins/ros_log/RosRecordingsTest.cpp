#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <cstdlib>

#include "ros_log/RosLog.h"

// Real logs; RosLogTest and ContainerTest check the same properties on small ones.
namespace omnimapper::ros::ros_recordings_test {
namespace {

using source::SourceReport;

class RosRecording : public ::testing::Test {
 protected:
  // The path of a recording, unpacked if it is there as .xz.
  std::optional<std::string> recording(const std::string& name) {
    if (const auto path = testing::sharedData(name)) return path;
    const auto packed = testing::sharedData(name + ".xz");
    if (!packed) return std::nullopt;
    const std::string path = folder_ / name.substr(name.rfind('/') + 1);
    return std::system(("xz -dc '" + *packed + "' > '" + path + "'").c_str()) == 0 ? std::optional(path) : std::nullopt;
  }
  static std::vector<mrpt::obs::CObservation::Ptr> read(RosLog& log) {
    std::vector<mrpt::obs::CObservation::Ptr> all;
    while (const auto observation = log.next()) all.push_back(observation);
    return all;
  }
  static std::uint64_t countOf(const RosLog& log, const std::string& label) {
    std::uint64_t count = 0;
    for (const auto& [name, counts] : log.report().sensors) count += name.first == label ? counts.observations : 0;
    return count;
  }
  static std::string refusal(const std::string& path) {
    try {
      RosLog log(path);
    } catch (const base::Error& error) {
      return error.what();
    }
    return "opened";
  }
  testing::ScratchFolder folder_;
};

TEST_F(RosRecording, ofOneDriveIsTheSameAsBagAndAsDb3) {
  const auto bag = recording("bags/jackal_mocap/test_2026-02-17-15-54-31.bag");
  const auto db3 = recording("bags/jackal_mocap/db3/test_2026-02-17-15-54-31.db3");
  OMNIMAPPER_NEEDS(bag && db3);
  RosLogOptions options;
  options.truth_topic = "/vrpn_client_node/jackal/pose";
  RosLog of_bag(*bag, options), of_db3(*db3, options);
  const auto a = read(of_bag), b = read(of_db3);
  ASSERT_EQ(a.size(), 414u);
  ASSERT_EQ(b.size(), 414u);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto& one = dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(*a[i]);
    const auto& other = dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(*b[i]);
    EXPECT_EQ(one.timestamp, other.timestamp);
    ASSERT_EQ(one.getScanSize(), 897u);
    ASSERT_EQ(other.getScanSize(), 897u);
    for (std::size_t k = 0; k < 897; ++k) ASSERT_EQ(one.getScanRange(k), other.getScanRange(k));
  }
  EXPECT_EQ(of_bag.truth().size(), 4734u);
  EXPECT_EQ(of_db3.truth().size(), 4734u);
}

TEST_F(RosRecording, ofATurtleBotHasItsOdometryInTf) {
  const auto path = recording("bags/misc/gmapping_test_turtlebot.bag");
  OMNIMAPPER_NEEDS(path);
  RosLog log(*path);
  read(log);
  EXPECT_EQ(countOf(log, "scan"), 819u);
  EXPECT_GT(countOf(log, "tf_odometry"), 1000u);
}

TEST_F(RosRecording, ofAnUpsideDownLaserIsMountedSo) {
  const auto path = recording("bags/misc/gmapping_test_replay_crash.bag");
  OMNIMAPPER_NEEDS(path);
  RosLog log(*path);
  std::size_t scans = 0, upside_down = 0;
  for (const auto& one : read(log)) {
    const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(one.get());
    if (!scan) continue;
    ++scans;
    upside_down += scan->sensorPose.getRotationMatrix()(2, 2) < 0 ? 1 : 0;
  }
  EXPECT_EQ(scans, 136u);
  EXPECT_EQ(upside_down, scans);
}

TEST_F(RosRecording, of2010WithTooLargeIndicesIsReadToItsEnd) {
  const auto path = recording("bags/misc/ccny_handheld_scan_only.bag");
  OMNIMAPPER_NEEDS(path);
  RosLog log(*path);
  EXPECT_EQ(read(log).size(), 360u);
  EXPECT_EQ(log.report().ending, SourceReport::Ending::complete);
}

TEST_F(RosRecording, ofATurtleBot4IsReadFromItsZstdChunks) {
  const auto path = recording("bags/ros2/turtlebot4_odom_tf_amcl_zstd.mcap");
  OMNIMAPPER_NEEDS(path);
  RosLog log(*path);
  EXPECT_EQ(read(log).size(), 2639u);
  EXPECT_EQ(log.report().ending, SourceReport::Ending::complete);
}

TEST_F(RosRecording, ofTwoLasersOnOneTopicHasTwoLabels) {
  const auto path = recording("bags/ros2/ld06_varying_beams/two_publishers_one_topic/mydata_0.db3");
  OMNIMAPPER_NEEDS(path);
  RosLog log(*path);
  read(log);
  EXPECT_EQ(countOf(log, "scan_base_laser"), 263u);
  EXPECT_EQ(countOf(log, "scan_laser_frame"), 259u);
}

TEST_F(RosRecording, withoutAnythingToMapIsRefusedWithWhatItHas) {
  const auto strings = recording("bags/broken/example-unsorted-chunks.bag");
  const auto nothing = recording("bags/broken/no-messages.bag");
  const auto split = recording("bags/ros2/resources/mcap/wbag");
  OMNIMAPPER_NEEDS(strings && nothing && split);
  EXPECT_NE(refusal(*strings).find("foo (std_msgs/String)"), std::string::npos) << refusal(*strings);
  EXPECT_NE(refusal(*nothing).find("has no messages"), std::string::npos) << refusal(*nothing);
  EXPECT_NE(refusal(*split).find("AAA (std_msgs/String)"), std::string::npos) << refusal(*split);
}

}  // namespace
}  // namespace omnimapper::ros::ros_recordings_test
