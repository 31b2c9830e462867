#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "../Input.h"
#include "../Targets.h"
#include "ros_log/CameraObservations.h"
#include "ros_log/Survey.h"

namespace omnimapper::fuzz {

namespace {

using ros::Value;

void takeScan(const Value& message) {
  const auto observation = ros::scanOf(message).observation;
  const auto& scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(*observation);
  for (std::size_t i = 0; i < scan.getScanSize(); ++i)
    require(!scan.getScanRangeValidity(i) || (std::isfinite(scan.getScanRange(i)) && scan.getScanRange(i) > 0),
            "a valid range that is none");
  ros::sweepOf(message);
}

void takeCloud(const Value& message) {
  const auto observation = ros::cloudOf(message).observation;
  const auto& cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud&>(*observation);
  for (const float x : cloud.pointcloud->getPointsBufferRef_x())
    require(std::isfinite(x), "a point that is not finite");
}

void takeImage(const Value& message) {
  const auto content = ros::imageContentOf(message.either("encoding", "format").text(), "/depth/image");
  const auto image = content == ros::ImageContent::depths ? ros::depthsOf(message) : ros::pictureOf(message);
  require(!image.empty(), "an image without pixels");
}

void takeOdometry(const Value& message) {
  const auto observation = ros::odometryOf(message).observation;
  const auto& pose = dynamic_cast<const mrpt::obs::CObservationOdometry&>(*observation).odometry;
  require(std::isfinite(pose.x()) && std::isfinite(pose.phi()), "a pose that is not finite");
}

struct Kind {
  const char* type;
  void (*take)(const Value& message);
};
constexpr std::array<Kind, 10> kKinds{
    {{"sensor_msgs/LaserScan", takeScan},
     {"sensor_msgs/MultiEchoLaserScan", takeScan},
     {"sensor_msgs/PointCloud2", takeCloud},
     {"sensor_msgs/Image", takeImage},
     {"sensor_msgs/CompressedImage", takeImage},
     {"nav_msgs/Odometry", takeOdometry},
     {"sensor_msgs/CameraInfo", [](const Value& message) { ros::cameraOf(message, false); }},
     {"sensor_msgs/Imu", [](const Value& message) { ros::imuOf(message); }},
     {"sensor_msgs/NavSatFix", [](const Value& message) { ros::gpsOf(message); }},
     {"tf2_msgs/TFMessage", [](const Value& message) { ros::transformsOf(message); }}}};

}  // namespace

void rosMessages(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const std::size_t kind = static_cast<std::size_t>(input.below(static_cast<int>(kKinds.size())));
  const auto encoding = input.flag() ? ros::Encoding::cdr : ros::Encoding::ros1;
  const bool has_own_definition = input.flag();
  const std::string_view rest(reinterpret_cast<const char*>(input.rest()), input.left());
  const std::size_t end = has_own_definition ? std::min(rest.find('\0'), rest.size()) : 0;
  const std::string text =
      has_own_definition ? std::string(rest.substr(0, end)) : ros::usualDefinition(kKinds[kind].type);
  try {
    const ros::Definition definition(kKinds[kind].type, text);
    kKinds[kind].take(
        decoded(definition.layout(), rest.substr(std::min(rest.size(), end + (end > 0 ? 1 : 0))), encoding));
  } catch (const ros::BadBytes& bad) {
    require(bad.what()[0] != '\0', "a refusal without a reason");
  } catch (const ros::BadDefinition& bad) {
    require(bad.what()[0] != '\0', "a refusal without a reason");
  }
}

}  // namespace omnimapper::fuzz
