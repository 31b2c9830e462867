#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>

#include "LogWriters.h"
#include "ros_log/Definition.h"
#include "ros_log/RosLog.h"

namespace omnimapper::ros::ros_log_test {
namespace {

using namespace ros_test;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using source::SourceReport;

constexpr std::int64_t kSecond = 1'000'000'000, kStart = 1'600'000'000 * kSecond;
const Pose kHere = {0, 0, 0, 0, 0, 0, 1};

enum TopicNumber : std::size_t { kScan, kOdom, kTf, kTfStatic, kOther, kPoseTopic };
const std::vector<Topic> kTopics = {{"/scan", "sensor_msgs/LaserScan", scanDefinition()},
                                    {"/odom", "nav_msgs/Odometry", odometryDefinition()},
                                    {"/tf", "tf2_msgs/TFMessage", transformDefinition()},
                                    {"/tf_static", "tf2_msgs/TFMessage", transformDefinition()},
                                    {"/thing", "my_msgs/Thing", "int32 x\n"}};

class RosLogOf : public ::testing::Test {
 protected:
  void scan(double at, const ScanFields& fields = {}, double header_offset = 0) {
    add(kScan, at, scanBytes(false, stamp(at + header_offset), fields));
  }
  void odometry(double at, const std::string& child, const Pose& pose) {
    add(kOdom, at, odometryBytes(false, stamp(at), child, pose));
  }
  void transform(double at, const std::string& parent, const std::string& child, const Pose& pose,
                 TopicNumber topic = kTfStatic) {
    add(topic, at, transformBytes(false, stamp(at), parent, child, pose));
  }
  void add(std::size_t topic, double at, const std::string& bytes) { messages_.push_back({topic, stamp(at), bytes}); }
  static std::int64_t stamp(double at) { return kStart + static_cast<std::int64_t>(std::llround(at * 1e9)); }

  std::vector<mrpt::obs::CObservation::Ptr> read(const RosLogOptions& options = {}) {
    BagWriter().write(path_, kTopics, messages_);
    RosLog log(path_, options);
    std::vector<mrpt::obs::CObservation::Ptr> all;
    while (const auto observation = log.next()) all.push_back(observation);
    report_ = log.report();
    return all;
  }
  template <class Class>
  std::vector<std::shared_ptr<Class>> readAs(const RosLogOptions& options = {}) {
    std::vector<std::shared_ptr<Class>> all;
    for (const auto& one : read(options))
      if (auto fitting = std::dynamic_pointer_cast<Class>(one)) all.push_back(fitting);
    return all;
  }
  static double secondsOf(const mrpt::obs::CObservation& observation) {
    return base::secondsBetween(base::stampFromUnix(1.6e9), observation.timestamp);
  }
  bool says(const std::vector<std::string>& lines, const std::string& text) const {
    for (const auto& line : lines)
      if (line.find(text) != std::string::npos) return true;
    return false;
  }
  std::string refusal(const RosLogOptions& options = {}) {
    try {
      read(options);
    } catch (const base::Error& error) {
      return error.what();
    }
    return "read";
  }

  testing::ScratchFolder folder_;
  std::string path_ = folder_ / "log.bag";
  std::vector<Written> messages_;
  SourceReport report_;
};

TEST_F(RosLogOf, aScanHasItsBeamsStampAndMounting) {
  // On the base, 0.2 m ahead, 0.3 m up, turned to the left by 90 deg.
  transform(0, "base_link", "laser", {0.2, 0, 0.3, 0, 0, std::sqrt(0.5), std::sqrt(0.5)});
  scan(1, {-0.5F, 0.5F, 0.1F, 10, {1, 2, 3, 4}});
  const auto scans = readAs<CObservation2DRangeScan>();
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans[0]->sensorLabel, "scan");
  EXPECT_NEAR(secondsOf(*scans[0]), 1, 1e-6);
  EXPECT_NEAR(scans[0]->aperture, 1.5, 1e-6);
  EXPECT_TRUE(scans[0]->rightToLeft);
  EXPECT_EQ(scans[0]->getScanRange(3), 4);
  EXPECT_NEAR(scans[0]->sensorPose.x(), 0.2, 1e-9);
  EXPECT_NEAR(scans[0]->sensorPose.z(), 0.3, 1e-9);
  EXPECT_NEAR(scans[0]->sensorPose.yaw(), M_PI / 2 + 0.25, 1e-6) << "the middle of -0.5 to 1 rad";
  EXPECT_EQ(report_.ending, SourceReport::Ending::complete);
}

TEST_F(RosLogOf, rangesWithoutEchoAndInvalidOnesAreTold) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  scan(1, {-1, 0.1F, 0.5F, 10, {1, 0.2F, 12, infinity, nan, 0, -infinity}});
  const auto scans = readAs<CObservation2DRangeScan>();
  ASSERT_EQ(scans.size(), 1u);
  const std::vector<bool> valid = {true, false, true, true, false, false, false};
  for (std::size_t i = 0; i < valid.size(); ++i) EXPECT_EQ(scans[0]->getScanRangeValidity(i), valid[i]) << i;
  EXPECT_EQ(scans[0]->getScanRange(2), 10) << "the largest range: no echo";
  EXPECT_EQ(scans[0]->getScanRange(3), 10);
  EXPECT_EQ(scans[0]->maxRange, 10);
}

TEST_F(RosLogOf, aLaserWithoutALimitHasEchoesAtAnyRange) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float stated : {0.F, infinity, -1.F}) {
    messages_.clear();
    scan(1, {-1, 1, 0.1F, stated, {1, 40, infinity}});
    const auto scans = readAs<CObservation2DRangeScan>();
    ASSERT_EQ(scans.size(), 1u);
    EXPECT_EQ(scans[0]->getScanRange(1), 40);
    EXPECT_LT(scans[0]->getScanRange(1), scans[0]->maxRange);
    EXPECT_EQ(scans[0]->getScanRange(2), scans[0]->maxRange);
  }
}

TEST_F(RosLogOf, sensorsOnAnotherBaseThatNothingConnectsAreOnTheBase) {
  odometry(1, "base_footprint", kHere);
  transform(1, "odom", "base_footprint", kHere, kTf);
  transform(0, "base_link", "laser", {0.3, 0, 0, 0, 0, 0, 1});
  scan(1.1);
  const auto scans = readAs<CObservation2DRangeScan>();
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_NEAR(scans[0]->sensorPose.x(), 0.3, 1e-9);
  EXPECT_TRUE(says(report_.notes, "no transform connects base_link with the base base_footprint"));
}

// Where the beam `index` ends in the frame of the base.
Eigen::Vector3d endOf(const CObservation2DRangeScan& scan, std::size_t index) {
  const double sign = scan.rightToLeft ? 1 : -1;
  const double angle = sign * (-0.5 * scan.aperture + scan.aperture * static_cast<double>(index) /
                                                          static_cast<double>(scan.getScanSize() - 1));
  mrpt::math::TPoint3D end;
  scan.sensorPose.composePoint(scan.getScanRange(index) * std::cos(angle), scan.getScanRange(index) * std::sin(angle),
                               0, end.x, end.y, end.z);
  return {end.x, end.y, end.z};
}

TEST_F(RosLogOf, aClockwiseOrUpsideDownLaserHitsWhatItSees) {
  const std::vector<float> ranges = {1, 2, 3};
  scan(1, {1.5F, -0.5F, 0.1F, 10, ranges});                     // clockwise from the left
  transform(0, "base_link", "under", {0, 0, 0.1, 1, 0, 0, 0});  // rolled by 180 deg
  transform(0, "base_link", "laser", kHere);
  scan(2, {-1.5F, 0.5F, 0.1F, 10, ranges, "under"});  // its right is the robot's left
  const auto scans = readAs<CObservation2DRangeScan>();
  ASSERT_EQ(scans.size(), 2u);
  for (const auto& scan : scans) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double angle = 1.5 - 0.5 * static_cast<double>(i);
      const auto end = endOf(*scan, i);
      EXPECT_NEAR(end.x(), ranges[i] * std::cos(angle), 1e-5);
      EXPECT_NEAR(end.y(), ranges[i] * std::sin(angle), 1e-5);
    }
  }
}

TEST_F(RosLogOf, twoLasersOnOneTopicAreToldApartByTheirFrames) {
  scan(1, {-1, 1, 0.1F, 10, {1, 2}, "left"});
  scan(2, {-1, 1, 0.1F, 10, {1, 2}, "/right"});
  const auto all = read();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0]->sensorLabel, "scan_left");
  EXPECT_EQ(all[1]->sensorLabel, "scan_right");
  EXPECT_TRUE(says(report_.doubts, "where on the robot")) << "two lasers at the base contradict each other";
}

TEST_F(RosLogOf, odometryOfAnotherFrameBecomesThatOfTheBase) {
  // The wheels' frame is 1 m ahead of the base and the robot has turned by 90 deg.
  transform(0, "base_link", "wheels", {1, 0, 0, 0, 0, 0, 1});
  odometry(1, "wheels", {5, 5, 0, 0, 0, std::sqrt(0.5), std::sqrt(0.5)});
  scan(1.1);
  RosLogOptions options;
  options.base_frame = "base_link";
  const auto all = readAs<CObservationOdometry>(options);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all[0]->odometry.x(), 5, 1e-9);
  EXPECT_NEAR(all[0]->odometry.y(), 4, 1e-9);
  EXPECT_NEAR(all[0]->odometry.phi(), M_PI / 2, 1e-9);
  EXPECT_FALSE(all[0]->hasVelocities) << "the wheels' frame moves sideways where the base turns";
  options.base_frame = "wheels";
  const auto of_wheels = readAs<CObservationOdometry>(options);
  ASSERT_EQ(of_wheels.size(), 1u);
  EXPECT_TRUE(of_wheels[0]->hasVelocities);
  EXPECT_NEAR(of_wheels[0]->velocityLocal.omega, 0.25, 1e-9);
}

TEST_F(RosLogOf, anyNumberOfFramesIsNamedInBoundedMemory) {
  for (int i = 0; i < 150; ++i) scan(0.01 * i, {-1, 1, 0.1F, 10, {1, 2}, "frame" + std::to_string(i)});
  scan(2, {-1, 1, 0.1F, 10, {1, 2}, std::string(2000, 'f')});
  EXPECT_EQ(read().size(), 150u);
  EXPECT_TRUE(says(report_.doubts, ", and perhaps more; their poses can be set"));
  EXPECT_TRUE(says(report_.notes, "has a frame whose name is longer than 1000 bytes"));
}

TEST_F(RosLogOf, odometryThatIsOnlyInTransformsIsFound) {
  transform(0, "base_link", "laser", {0.5, 0, 0, 0, 0, 0, 1});
  for (int i = 1; i < 5; ++i) {
    transform(i, "map", "odom", {0.1 * i, 0, 0, 0, 0, 0, 1}, kTf);
    transform(i, "odom", "base_link", {1.0 * i, 0, 0, 0, 0, 0, 1}, kTf);
    transform(i, "odom", "base_link", {1.0 * i, 0, 0, 0, 0, 0, 1}, kTf);  // repeated, as some publishers do
    scan(i + 0.1);
  }
  const auto all = readAs<CObservationOdometry>();
  ASSERT_EQ(all.size(), 4u);
  EXPECT_NEAR(all[3]->odometry.x(), 4, 1e-9);
  RosLogOptions without;
  without.odometry = "none";
  EXPECT_EQ(readAs<CObservationOdometry>(without).size(), 0u);
}

TEST_F(RosLogOf, aJointMovesItsSensor) {
  // The laser is raised by 0.1 m a second; the scan is between two transforms, and recorded before the later one.
  for (int i = 0; i < 10; ++i) {
    transform(0.25 * i, "base_link", "laser", {0, 0, 0.025 * i, 0, 0, 0, 1}, kTf);
    if (i == 4) scan(1.1);
  }
  scan(9);  // long after the last transform
  const auto scans = readAs<CObservation2DRangeScan>();
  ASSERT_EQ(scans.size(), 1u);
  EXPECT_NEAR(scans[0]->sensorPose.z(), 0.11, 1e-6);
  EXPECT_TRUE(says(report_.notes, "no transform from base_link to laser at that time"));
}

TEST_F(RosLogOf, clocksThatDifferAreMovedAndTold) {
  for (int i = 0; i < 5; ++i) {
    scan(i, {}, -100);  // the laser's computer is 100 s behind
    odometry(i + 0.25, "base_link", kHere);
  }
  const auto all = read();
  ASSERT_EQ(all.size(), 10u);
  EXPECT_NEAR(base::secondsBetween(all[0]->timestamp, all[1]->timestamp), 0.25, 1e-6);
  EXPECT_NEAR(secondsOf(*all[0]), -100, 1e-6) << "the laser's clock is that of the log";
  EXPECT_TRUE(says(report_.doubts, "/odom (frame base_link) is 100.000 s ahead of")) << report_.doubts.size();
  RosLogOptions recorded;
  recorded.stamps = StampsOf::recorded;
  EXPECT_NEAR(secondsOf(*read(recorded)[0]), 0, 1e-6);
}

TEST_F(RosLogOf, theTableNamesWhatIsLeftOutAndWhy) {
  scan(1);
  add(kOther, 2, "\1\2\3\4");
  add(kScan, 3, "too short");
  read();
  EXPECT_TRUE(says(report_.notes, "/thing (my_msgs/Thing): 1 message; left out: a type that is not used"));
  EXPECT_TRUE(says(report_.notes,
                   "/scan (sensor_msgs/LaserScan): 2 messages; scan: 1; left out: 1, a message that ends too early"));
  EXPECT_EQ(report_.other_objects.at("my_msgs/Thing"), 1u);
}

TEST_F(RosLogOf, aLogWithNothingToMapIsRefusedWithWhatItHas) {
  add(kOther, 2, "\1\2\3\4");
  EXPECT_NE(refusal().find("/thing (my_msgs/Thing)"), std::string::npos) << refusal();
  messages_.clear();
  EXPECT_NE(refusal().find("a map"), std::string::npos) << refusal();
}

TEST_F(RosLogOf, topicsAndLabelsAreChosen) {
  scan(1);
  odometry(1, "base_link", kHere);
  RosLogOptions options;
  options.topics = {"/scan"};
  options.labels = {"/scan=front"};
  const auto all = read(options);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0]->sensorLabel, "front");
  options.topics = {"/scna"};
  EXPECT_NE(refusal(options).find("no messages that are read of the topic '/scna'; it has"), std::string::npos)
      << refusal(options);
  options.topics = {};
  options.labels = {"front"};
  EXPECT_NE(refusal(options).find("not of the form"), std::string::npos);
  options.labels = {};
  options.base_frame = "bsae";
  EXPECT_NE(refusal(options).find("no frame 'bsae'"), std::string::npos) << refusal(options);
}

TEST_F(RosLogOf, posesAreGivenOrTrueOnlyOnRequest) {
  scan(1);
  odometry(1, "base_link", {1, 0, 0, 0, 0, 0, 1});
  odometry(1.1, "base_link", {2, 0, 0, 0, 0, 0, 1});
  RosLogOptions options;
  options.pose_topics = {"/odom"};
  EXPECT_EQ(readAs<mrpt::obs::CObservationRobotPose>(options).size(), 2u);
  options = {};
  options.truth_topic = "/odom";
  EXPECT_EQ(read(options).size(), 1u);
  EXPECT_TRUE(says(report_.doubts, "the true poses of /odom are those of the body"));
  options.base_frame = "base_link";
  EXPECT_EQ(read(options).size(), 1u);
  EXPECT_FALSE(says(report_.doubts, "true poses")) << "they are those of the base";
  RosLog log(path_, options);
  ASSERT_EQ(log.truth().size(), 2u);
  const auto between = log.truthAt(base::stampFromUnix(1.6e9) + base::durationFromSeconds(1.05));
  ASSERT_TRUE(between);
  EXPECT_NEAR(between->translation.x(), 1.5, 1e-6);
  EXPECT_FALSE(log.truthAt(base::stampFromUnix(1.6e9)));
}

TEST_F(RosLogOf, oneRecordingInThreeFormatsIsTheSame) {
  for (int i = 0; i < 5; ++i) scan(0.1 * i);
  const auto of_bag = readAs<CObservation2DRangeScan>();
  auto in_cdr = messages_;
  for (std::size_t i = 0; i < in_cdr.size(); ++i) in_cdr[i].bytes = scanBytes(true, in_cdr[i].time);
  const std::vector<Topic> topics = {{"/scan", "sensor_msgs/msg/LaserScan", usualDefinition("sensor_msgs/LaserScan")}};
  const std::string mcap = folder_ / "log.mcap", db3 = folder_ / "log.db3";
  McapWriter().write(mcap, topics, in_cdr);
  Db3Writer without;
  without.has_definitions = false;
  without.write(db3, topics, in_cdr);
  for (const auto& path : {mcap, db3}) {
    RosLog log(path);
    for (const auto& expected : of_bag) {
      const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(log.next());
      ASSERT_TRUE(scan) << path;
      EXPECT_EQ(scan->timestamp, expected->timestamp);
      EXPECT_TRUE(scan->sensorPose == expected->sensorPose);
      for (std::size_t k = 0; k < expected->getScanSize(); ++k)
        EXPECT_EQ(scan->getScanRange(k), expected->getScanRange(k));
    }
    EXPECT_FALSE(log.next());
  }
}

// The bytes of a message of ROS 1 begin with the number in its header.
TEST_F(RosLogOf, aDriverThatStartedAnewIsTold) {
  const auto numbered = [&](double at, std::uint64_t header_number, const std::string& frame) {
    ScanFields fields;
    fields.frame = frame;
    add(kScan, at, number(header_number, 4) + scanBytes(false, stamp(at), fields).substr(4));
  };
  for (int i = 0; i < 60; ++i) numbered(0.1 * i, static_cast<std::uint64_t>(i < 40 ? 100 + i : i - 40), "");
  EXPECT_EQ(read().size(), 60u);
  EXPECT_TRUE(says(report_.doubts,
                   "'scan': the numbers in its headers begin again 1 time, first 4.0 s after its first "
                   "message: its driver started anew"))
      << ::testing::PrintToString(report_.doubts);
  messages_.clear();
  for (int i = 0; i < 60; ++i) numbered(0.1 * i, static_cast<std::uint64_t>(i % 2 == 0 ? 1000 + i : i), "");
  read();
  EXPECT_TRUE(says(report_.doubts, "several programs publish its topic"));
  messages_.clear();
  for (int i = 0; i < 60; ++i) numbered(0.1 * i, static_cast<std::uint64_t>(i % 10 == 9 ? i - 3 : i), "");
  read();
  EXPECT_FALSE(says(report_.doubts, "begin again")) << "messages that overtook each other";
}

}  // namespace
}  // namespace omnimapper::ros::ros_log_test
