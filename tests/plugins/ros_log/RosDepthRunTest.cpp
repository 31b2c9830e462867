#include <gtest/gtest.h>
#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/testing/MapperRun.h>

#include <cmath>
#include <functional>
#include <limits>

#include "LogWriters.h"
#include "ros_log/Definition.h"
#include "ros_log/RosLog.h"

// Logs with depths and clouds of a room, as drivers write them, from the file to the map.
namespace omnimapper::ros::ros_depth_run_test {
namespace {

using namespace ros_test;
using Eigen::Vector3d;

/// An empty room, relative to where the robot starts [m].
const Vector3d kLow(-1, -1.5, 0), kHigh(4, 1.5, 2.2);

/// Distance from a point in the room along a direction to what bounds it, as a multiple of the direction.
double distanceAlong(const Vector3d& from, const Vector3d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) continue;
    nearest = std::min(nearest, ((direction[axis] > 0 ? kHigh : kLow)[axis] - from[axis]) / direction[axis]);
  }
  return nearest;
}

/// A robot drives 1.4 m ahead in the room, and stops every 0.2 m. Its camera is 1 m high and looks ahead and down by
/// 0.2 rad.
class RosDepthRun : public ::testing::Test {
 protected:
  static constexpr int kStops = 8, kColumns = 320, kRows = 240;
  static constexpr double kFocal = 260;  // [px]

  RosDepthRun() {
    const Eigen::Quaterniond optical(-0.5, 0.5, -0.5, 0.5);  // z ahead, x to the right
    rotation_ = Eigen::AngleAxisd(0.2, Vector3d::UnitY()) * optical;
    const std::vector<double> mounted = {0.1, 0, 1, rotation_.x(), rotation_.y(), rotation_.z(), rotation_.w()};
    add("/tf_static", "tf2_msgs/TFMessage", 0, transformBytes(true, stamp(0), "base_link", "optical", mounted));
    for (int stop = 0; stop < kStops; ++stop)
      add("/odom", "nav_msgs/Odometry", stop,
          odometryBytes(true, stamp(stop), "base_link", {0.2 * stop, 0, 0, 0, 0, 0, 1}));
  }
  static std::int64_t stamp(double at) { return 1'600'000'000'000'000'000 + std::llround(at * 1e9); }
  void add(const std::string& topic, const std::string& type, double at, const std::string& bytes) {
    std::size_t index = 0;
    while (index < topics_.size() && topics_[index].name != topic) ++index;
    if (index == topics_.size()) topics_.push_back({topic, type, usualDefinition(type)});
    messages_.push_back({index, stamp(at), bytes});
  }
  // Depth [m] of a pixel.
  double depth(int stop, int column, int row) const {
    const Vector3d ray((column - 159.5) / kFocal, (row - 119.5) / kFocal, 1);
    return distanceAlong({0.1 + 0.2 * stop, 0, 1}, rotation_ * ray);
  }
  void addImages(const std::string& encoding, const std::function<void(Serializer&, double depth)>& pixel) {
    Serializer info(true);
    info.header(stamp(0), "optical").uint(kRows, 4).uint(kColumns, 4).text("plumb_bob").uint(0, 4);
    info.reals({kFocal, 0, 159.5, 0, kFocal, 119.5, 0, 0, 1}).reals({1, 0, 0, 0, 1, 0, 0, 0, 1});
    info.reals({kFocal, 0, 159.5, 0, 0, kFocal, 119.5, 0, 0, 0, 1, 0});
    info.uint(0, 4).uint(0, 4).uint(0, 4).uint(0, 4).uint(0, 4).uint(0, 4).uint(0, 1);
    add("/camera/depth_registered/camera_info", "sensor_msgs/CameraInfo", 0, info.bytes());
    for (int stop = 0; stop < kStops; ++stop) {
      Serializer pixels(false);
      for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) pixel(pixels, depth(stop, column, row));
      Serializer out(true);
      out.header(stamp(stop), "optical").uint(kRows, 4).uint(kColumns, 4).text(encoding).uint(0, 1);
      out.uint(pixels.bytes().size() / kRows, 4).uint(pixels.bytes().size(), 4).raw(pixels.bytes());
      add("/camera/depth_registered/image_raw", "sensor_msgs/Image", stop, out.bytes());
    }
  }
  // Points with x, y, z and a time.
  void addClouds(const std::string& frame, int height, const std::function<std::vector<Vector3d>(int stop)>& points) {
    constexpr std::uint64_t kStep = 16;
    for (int stop = 0; stop < kStops; ++stop) {
      const auto all = points(stop);
      const std::uint64_t width = all.size() / static_cast<std::uint64_t>(height);
      Serializer out(true), data(false);
      out.header(stamp(stop), frame).uint(static_cast<std::uint64_t>(height), 4).uint(width, 4).uint(4, 4);
      const char* names[] = {"x", "y", "z", "time"};
      for (std::uint64_t i = 0; i < 4; ++i) out.text(names[i]).uint(4 * i, 4).uint(7, 1).uint(1, 4);
      for (const auto& point : all) {
        for (int axis = 0; axis < 3; ++axis) data.real32(static_cast<float>(point[axis]));
        data.real32(0);
      }
      out.uint(0, 1).uint(kStep, 4).uint(width * kStep, 4).uint(data.bytes().size(), 4).raw(data.bytes()).uint(0, 1);
      add("/points", "sensor_msgs/PointCloud2", stop, out.bytes());
    }
  }
  // Distances of the map's surfaces with more than 0.5 m^2 from the room's bounds that they are parallel to, by bound:
  // its axis and whether it is the higher one.
  std::map<std::pair<int, bool>, double> mapped(const std::string& extractor) {
    McapWriter().write(path_, topics_, messages_);
    const auto engine = testing::makeEngine(
        "[mapper]\nmotion = spatial\npose_plugins = odometry, no_motion\nmeasurement_plugins = plane_landmarks\n"
        "[trigger]\ndistance_m = 0.1\n[perception]\nextractors = planes\n[odometry]\nclass = OdometryPlugin\n"
        "[no_motion]\nclass = NoMotionPlugin\n[planes]\nclass = " +
        extractor + "\n[plane_landmarks]\nclass = PlaneLandmarksPlugin\n");
    RosLog log(path_);
    while (const auto observation = log.next()) engine->add(observation);
    engine->finish();
    const auto view = engine->view();
    EXPECT_EQ(view.map.key_frames.size(), static_cast<std::size_t>(kStops));
    std::map<std::pair<int, bool>, double> found;
    for (const auto& landmark : derived::shapesOf(view)) {
      if (landmark.shape.surfaces.empty() || derived::areaOf(landmark.shape) < 0.5) continue;
      const auto plane = derived::planeOf(landmark.shape.surfaces.front(), landmark.shape);
      int axis = 0;
      plane.normal.cwiseAbs().maxCoeff(&axis);
      EXPECT_GT(std::abs(plane.normal[axis]), 0.999) << plane.normal.transpose();
      const double at = landmark.shape.surfaces.front().vertices.front()[axis];
      const bool is_high = at > 0.5 * (kLow[axis] + kHigh[axis]);
      const double off = std::abs(at - (is_high ? kHigh : kLow)[axis]);
      auto& worst = found[{axis, is_high}];
      worst = std::max(worst, off);
    }
    return found;
  }
  void expectRoom(const std::string& extractor, double tolerance) {
    const auto found = mapped(extractor);
    const std::pair<int, bool> ahead{0, true}, floor{2, false}, left{1, true}, right{1, false};
    std::string text;
    for (const auto& [bound, off] : found)
      text +=
          "axis " + std::to_string(bound.first) + (bound.second ? " high: " : " low: ") + std::to_string(off) + "\n";
    for (const auto& bound : {ahead, floor, left, right}) {
      ASSERT_EQ(found.count(bound), 1u) << "axis " << bound.first << (bound.second ? " high" : " low") << " of\n"
                                        << text;
      EXPECT_LT(found.at(bound), tolerance) << text;
    }
  }

  testing::ScratchFolder folder_;
  std::string path_ = folder_ / "log.mcap";
  std::vector<Topic> topics_;
  std::vector<Written> messages_;
  Eigen::Quaterniond rotation_;  // of the optical frame on the base
};

TEST_F(RosDepthRun, depthsInMillimetresMapTheRoom) {
  addImages("16UC1",
            [](Serializer& out, double depth) { out.uint(static_cast<std::uint64_t>(std::llround(1000 * depth)), 2); });
  expectRoom("PlaneExtractor", 0.02);
}

TEST_F(RosDepthRun, depthsInMetresMapTheRoom) {
  addImages("32FC1", [](Serializer& out, double depth) { out.real32(static_cast<float>(depth)); });
  expectRoom("PlaneExtractor", 0.02);
}

TEST_F(RosDepthRun, organisedCloudsMapTheRoom) {
  addClouds("optical", kRows, [&](int stop) {
    std::vector<Vector3d> points;
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        const bool is_missing = row == 7 && column % 2 == 0;
        const double z = is_missing ? std::nan("") : depth(stop, column, row);
        points.emplace_back(z * (column - 159.5) / kFocal, z * (row - 119.5) / kFocal, z);
      }
    return points;
  });
  expectRoom("CloudPlaneExtractor", 0.02);
}

// 64 rings, as lasers that turn have them, in a frame of their own.
TEST_F(RosDepthRun, cloudsOfALaserWithRingsMapTheRoom) {
  add("/tf_static", "tf2_msgs/TFMessage", 0,
      transformBytes(true, stamp(0), "base_link", "lidar", {0.1, 0, 1, 0, 0, 0, 1}));
  addClouds("lidar", 1, [&](int stop) {
    std::vector<Vector3d> points;
    for (int ring = 0; ring < 64; ++ring) {
      const double up = -0.5 + 0.7 * ring / 63;  // [rad]
      for (int i = 0; i < 720; ++i) {
        const double around = 2 * M_PI * i / 720;
        const Vector3d ray(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around), std::sin(up));
        points.push_back(distanceAlong({0.1 + 0.2 * stop, 0, 1}, ray) * ray);
      }
    }
    return points;
  });
  expectRoom("CloudPlaneExtractor", 0.02);
}

}  // namespace
}  // namespace omnimapper::ros::ros_depth_run_test
