#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <tuple>

#include "LogWriters.h"
#include "ros_log/Definition.h"
#include "ros_log/RosLog.h"

namespace omnimapper::ros::ros_camera_test {
namespace {

using namespace ros_test;
using mrpt::obs::CObservation3DRangeScan;

constexpr std::int64_t kStart = 1'600'000'000'000'000'000;

class RosCamera : public ::testing::Test {
 protected:
  void add(const std::string& topic, const std::string& type, double at, const std::string& bytes) {
    std::size_t index = 0;
    while (index < topics_.size() && topics_[index].name != topic) ++index;
    if (index == topics_.size()) topics_.push_back({topic, type, usualDefinition(type)});
    messages_.push_back({index, stamp(at), bytes});
  }
  static std::int64_t stamp(double at) { return kStart + std::llround(at * 1e9); }
  void info(const std::string& topic, const std::string& frame, double focal) {
    Serializer out(true);
    out.header(stamp(0), frame).uint(2, 4).uint(3, 4).text("plumb_bob").uint(0, 4);
    out.reals({focal, 0, 1, 0, focal, 0.5, 0, 0, 1}).reals({1, 0, 0, 0, 1, 0, 0, 0, 1});
    out.reals({focal, 0, 1, 0, 0, focal, 0.5, 0, 0, 0, 1, 0});
    out.uint(0, 4).uint(0, 4).uint(0, 4).uint(0, 4).uint(0, 4).uint(0, 4).uint(0, 1);
    add(topic, "sensor_msgs/CameraInfo", 0, out.bytes());
  }
  // Three columns, two rows.
  void image(const std::string& topic, const std::string& frame, double at, const std::string& encoding,
             const std::string& pixels) {
    Serializer out(true);
    out.header(stamp(at), frame).uint(2, 4).uint(3, 4).text(encoding).uint(0, 1);
    out.uint(pixels.size() / 2, 4).uint(pixels.size(), 4).raw(pixels);
    add(topic, "sensor_msgs/Image", at, out.bytes());
  }
  void compressed(const std::string& topic, const std::string& frame, double at, const std::string& format,
                  const std::string& data) {
    Serializer out(true);
    out.header(stamp(at), frame).text(format).uint(data.size(), 4).raw(data);
    add(topic, "sensor_msgs/CompressedImage", at, out.bytes());
  }
  void mount(const std::string& parent, const std::string& child, const Pose& pose) {
    add("/tf_static", "tf2_msgs/TFMessage", 0, transformBytes(true, stamp(0), parent, child, pose));
  }
  std::vector<mrpt::obs::CObservation::Ptr> read() {
    McapWriter().write(path_, topics_, messages_);
    RosLog log(path_);
    std::vector<mrpt::obs::CObservation::Ptr> all;
    while (const auto observation = log.next()) all.push_back(observation);
    for (const auto& note : log.report().notes) notes_ += note + "\n";
    return all;
  }
  static std::string depths(const std::vector<int>& millimetres) {
    std::string bytes;
    for (const int value : millimetres) bytes += number(static_cast<std::uint64_t>(value), 2);
    return bytes;
  }
  static std::string png(const cv::Mat& image) {
    std::vector<unsigned char> bytes;
    cv::imencode(".png", image, bytes);
    return std::string(bytes.begin(), bytes.end());
  }

  testing::ScratchFolder folder_;
  std::string path_ = folder_ / "log.mcap", notes_;
  std::vector<Topic> topics_;
  std::vector<Written> messages_;
  // An optical frame that looks ahead, 1 m up.
  const Pose optical_ = {0, 0, 1, -0.5, 0.5, -0.5, 0.5};
};

TEST_F(RosCamera, registeredDepthsGetThePictureOfTheirTime) {
  mount("base_link", "optical", optical_);
  info("/camera/depth_registered/camera_info", "optical", 500);
  info("/camera/rgb/camera_info", "optical", 500);
  image("/camera/rgb/image_raw", "optical", 0.9, "rgb8", std::string(18, '\x10'));
  image("/camera/depth_registered/image_raw", "optical", 1, "16UC1", depths({1000, 2000, 0, 4, 5, 6}));
  image("/camera/rgb/image_raw", "optical", 1.01, "rgb8", std::string("\xff\0\0", 3) + std::string(15, '\0'));
  const auto all = read();
  ASSERT_EQ(all.size(), 1u) << "pictures come with their depths";
  const auto& scan = dynamic_cast<const CObservation3DRangeScan&>(*all[0]);
  EXPECT_EQ(scan.sensorLabel, "camera/depth_registered/image_raw");
  EXPECT_EQ(scan.rangeImage(0, 1), 2000);
  EXPECT_FLOAT_EQ(scan.rangeUnits, 0.001F);
  EXPECT_TRUE(scan.range_is_depth);
  EXPECT_EQ(scan.cameraParams.fx(), 500);
  EXPECT_EQ(scan.cameraParams.cy(), 0.5);
  ASSERT_TRUE(scan.hasIntensityImage);
  EXPECT_EQ(scan.intensityImage.at<std::uint8_t>(0, 0, 2), 0xff) << "red, the third channel";
  EXPECT_NEAR(scan.sensorPose.z(), 1, 1e-9);
  EXPECT_NEAR(scan.sensorPose.yaw(), 0, 1e-9);
  EXPECT_NEAR(scan.sensorPose.roll(), 0, 1e-9) << "x is ahead";
  EXPECT_NEAR(scan.relativePoseIntensityWRTDepth.yaw(), -M_PI / 2, 1e-6);
}

TEST_F(RosCamera, aPictureOfAnotherCameraHasItsPlace) {
  mount("base_link", "depth_optical", optical_);
  mount("depth_optical", "color_optical", {0.05, 0, 0, 0, 0, 0, 1});  // 5 cm to the right
  info("/camera/depth/camera_info", "depth_optical", 400);
  info("/camera/color/camera_info", "color_optical", 600);
  image("/camera/depth/image_rect_raw", "depth_optical", 1, "32FC1",
        Serializer(false).real32(1.5F).real32(std::nanf("")).real32(100).real32(0).real32(-1).real32(2).bytes());
  image("/camera/color/image_raw", "color_optical", 1.015, "bgr8", std::string(18, '\x20'));
  const auto all = read();
  ASSERT_EQ(all.size(), 1u);
  const auto& scan = dynamic_cast<const CObservation3DRangeScan&>(*all[0]);
  EXPECT_EQ(scan.rangeImage(0, 0), 1500);
  EXPECT_EQ(scan.rangeImage(0, 1), 0);
  EXPECT_EQ(scan.rangeImage(0, 2), 0);
  EXPECT_EQ(scan.rangeImage(1, 2), 2000);
  EXPECT_EQ(scan.cameraParams.fx(), 400);
  EXPECT_EQ(scan.cameraParamsIntensity.fx(), 600);
  EXPECT_NEAR(scan.relativePoseIntensityWRTDepth.y(), -0.05, 1e-6) << "y is to the left";
}

TEST_F(RosCamera, imagesWithoutCalibrationAreLeftOutAndNamed) {
  mount("base_link", "optical", optical_);
  add("/scan", "sensor_msgs/LaserScan", 1, scanBytes(true, stamp(1)));
  image("/depth/image", "optical", 1, "16UC1", depths({1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(read().size(), 1u);
  EXPECT_NE(notes_.find("left out: no CameraInfo of their camera"), std::string::npos) << notes_;
}

TEST_F(RosCamera, compressedImagesAreRead) {
  const cv::Mat values = (cv::Mat_<std::uint16_t>(2, 3) << 1000, 2000, 0, 1, 2, 3);
  info("/depth/camera_info", "optical", 500);
  compressed("/depth/image/compressedDepth", "optical", 1, "16UC1; compressedDepth png",
             std::string(12, '\0') + png(values));
  info("/rgb/camera_info", "other", 500);
  compressed("/rgb/image/compressed", "other", 1, "rgb8; png", png(cv::Mat(2, 3, CV_8UC3, cv::Scalar(1, 2, 3))));
  compressed("/rgb/image/compressed", "other", 2, "rgb8; png", "no PNG");
  const auto all = read();
  ASSERT_EQ(all.size(), 2u);
  for (const auto& one : all) {
    if (const auto* scan = dynamic_cast<const CObservation3DRangeScan*>(one.get())) {
      EXPECT_EQ(scan->rangeImage(0, 1), 2000);
    } else {
      const auto& view = dynamic_cast<const mrpt::obs::CObservationImage&>(*one);
      EXPECT_EQ(view.image.at<std::uint8_t>(0, 0, 0), 1);
      EXPECT_NEAR(view.cameraPose.yaw(), -M_PI / 2, 1e-6) << "not mounted: it looks ahead";
    }
  }
  EXPECT_NE(notes_.find("cannot be decoded"), std::string::npos) << notes_;
}

// A decoder would allocate 7 GB for these 29 bytes.
TEST_F(RosCamera, anImageThatStatesMorePixelsThanAnyCameraHasIsNotDecoded) {
  const auto big_endian = [](std::uint64_t value) {
    const std::string little = number(value, 4);
    return std::string(little.rbegin(), little.rend());
  };
  const std::string header = "IHDR" + big_endian(60000) + big_endian(60000) + std::string("\x10\0\0\0\0", 5);
  const auto checksum = ::crc32(0, reinterpret_cast<const Bytef*>(header.data()), static_cast<uInt>(header.size()));
  info("/depth/camera_info", "optical", 500);
  compressed("/depth/image/compressed", "optical", 1, "16UC1; png compressed ",
             "\x89PNG\r\n\x1a\n" + big_endian(13) + header + big_endian(checksum));
  EXPECT_TRUE(read().empty());
  EXPECT_NE(notes_.find("60000 x 60000 pixels, more than any camera has"), std::string::npos) << notes_;
}

TEST_F(RosCamera, depthsAreAlsoReadOfAPlainPng) {
  const cv::Mat values = (cv::Mat_<std::uint16_t>(2, 3) << 1000, 2000, 0, 1, 2, 3);
  info("/depth/camera_info", "optical", 500);
  compressed("/depth/image/compressed", "optical", 1, "16UC1; png compressed ", png(values));
  const auto all = read();
  ASSERT_EQ(all.size(), 1u) << notes_;
  EXPECT_EQ(dynamic_cast<const CObservation3DRangeScan&>(*all[0]).rangeImage(0, 1), 2000);
}

TEST_F(RosCamera, greyValuesOf16BitsAreDepthsOnlyWhereTheTopicSaysSo) {
  mount("base_link", "optical", optical_);
  info("/depth/camera_info", "optical", 500);
  info("/ir/camera_info", "optical", 500);
  image("/depth/image_raw", "optical", 1, "mono16", depths({1000, 2000, 0, 4, 5, 6}));
  image("/ir/image_raw", "optical", 1, "mono16", depths({1, 2, 3, 4, 5, 6}));
  const auto all = read();
  ASSERT_EQ(all.size(), 1u) << notes_;
  const auto& scan = dynamic_cast<const CObservation3DRangeScan&>(*all[0]);
  EXPECT_EQ(scan.rangeImage(0, 1), 2000);
  EXPECT_FALSE(scan.hasIntensityImage);
  EXPECT_NE(notes_.find("/ir/image_raw (sensor_msgs/Image): 1 message; left out: grey values of 16 bits"),
            std::string::npos)
      << notes_;
}

TEST_F(RosCamera, aCloudHasItsFinitePoints) {
  Serializer out(true);
  out.header(stamp(1), "lidar").uint(1, 4).uint(2, 4).uint(3, 4);
  const char* names[] = {"x", "y", "z"};
  for (std::uint64_t i = 0; i < 3; ++i) out.text(names[i]).uint(4 * i, 4).uint(7, 1).uint(1, 4);
  const std::string data =
      Serializer(false).real32(1).real32(2).real32(3).real32(std::nanf("")).real32(0).real32(0).bytes();
  out.uint(0, 1).uint(12, 4).uint(24, 4).uint(data.size(), 4).raw(data).uint(1, 1);
  mount("base_link", "lidar", {0, 0, 2, 0, 0, 0, 1});
  add("/points", "sensor_msgs/PointCloud2", 1, out.bytes());
  const auto all = read();
  ASSERT_EQ(all.size(), 1u);
  const auto& cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud&>(*all[0]);
  ASSERT_EQ(cloud.pointcloud->size(), 1u);
  float x = 0, y = 0, z = 0;
  cloud.pointcloud->getPoint(0, x, y, z);
  EXPECT_EQ(z, 3);
  EXPECT_NEAR(cloud.sensorPose.z(), 2, 1e-9);
}

// Two rows with a gap between them, points of 24 bytes: x, y, z, ring and time.
TEST_F(RosCamera, anOrganisedCloudIsReadRowByRowAndWhatIsNotUsedIsSaid) {
  constexpr std::uint64_t kStep = 24, kRow = 56;
  Serializer out(true);
  out.header(stamp(1), "lidar").uint(2, 4).uint(2, 4).uint(5, 4);
  const std::tuple<const char*, std::uint64_t, std::uint64_t> fields[] = {
      {"x", 0, 7}, {"y", 4, 7}, {"z", 8, 7}, {"ring", 12, 4}, {"time", 16, 7}};
  for (const auto& [name, offset, type] : fields) out.text(name).uint(offset, 4).uint(type, 1).uint(1, 4);
  std::string data;
  for (const float x : {1.F, 2.F, 3.F, 4.F}) {
    data += Serializer(false).real32(x).real32(0).real32(-1).uint(5, 2).uint(0, 2).real32(0.01F).uint(0, 4).bytes();
    if (data.size() == 2 * kStep) data += std::string(kRow - 2 * kStep, '\x7f');
  }
  data += std::string(kRow - 2 * kStep, '\x7f');
  out.uint(0, 1).uint(kStep, 4).uint(kRow, 4).uint(data.size(), 4).raw(data).uint(0, 1);
  add("/points", "sensor_msgs/PointCloud2", 1, out.bytes());
  const auto all = read();
  ASSERT_EQ(all.size(), 1u);
  const auto& cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud&>(*all[0]);
  ASSERT_EQ(cloud.pointcloud->size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    float x = 0, y = 0, z = 0;
    cloud.pointcloud->getPoint(i, x, y, z);
    EXPECT_EQ(x, static_cast<float>(i + 1));
    EXPECT_EQ(z, -1);
  }
  EXPECT_NE(notes_.find("/points (frame lidar) has points with ring, time, which are not used"), std::string::npos)
      << notes_;
}

}  // namespace
}  // namespace omnimapper::ros::ros_camera_test
