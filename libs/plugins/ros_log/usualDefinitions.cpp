#include <algorithm>
#include <map>

#include "Definition.h"

namespace omnimapper::ros {

namespace {

struct UsualType {
  const char* fields;
  const char* contains;  // other types of this table, separated by blanks
};

// The fields of the messages that are read, as ROS 2 has them since Humble.
const std::map<std::string, UsualType>& usualTypes() {
  static const std::map<std::string, UsualType> types = {
      {"builtin_interfaces/Time", {"int32 sec\nuint32 nanosec\n", ""}},
      {"std_msgs/Header", {"builtin_interfaces/Time stamp\nstring frame_id\n", "builtin_interfaces/Time"}},
      {"geometry_msgs/Point", {"float64 x\nfloat64 y\nfloat64 z\n", ""}},
      {"geometry_msgs/Vector3", {"float64 x\nfloat64 y\nfloat64 z\n", ""}},
      {"geometry_msgs/Quaternion", {"float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n", ""}},
      {"geometry_msgs/Pose",
       {"Point position\nQuaternion orientation\n", "geometry_msgs/Point geometry_msgs/Quaternion"}},
      {"geometry_msgs/PoseStamped", {"std_msgs/Header header\nPose pose\n", "std_msgs/Header geometry_msgs/Pose"}},
      {"geometry_msgs/PoseWithCovariance", {"Pose pose\nfloat64[36] covariance\n", "geometry_msgs/Pose"}},
      {"geometry_msgs/PoseWithCovarianceStamped",
       {"std_msgs/Header header\nPoseWithCovariance pose\n", "std_msgs/Header geometry_msgs/PoseWithCovariance"}},
      {"geometry_msgs/Twist", {"Vector3 linear\nVector3 angular\n", "geometry_msgs/Vector3"}},
      {"geometry_msgs/TwistWithCovariance", {"Twist twist\nfloat64[36] covariance\n", "geometry_msgs/Twist"}},
      {"geometry_msgs/Transform",
       {"Vector3 translation\nQuaternion rotation\n", "geometry_msgs/Vector3 geometry_msgs/Quaternion"}},
      {"geometry_msgs/TransformStamped",
       {"std_msgs/Header header\nstring child_frame_id\nTransform transform\n",
        "std_msgs/Header geometry_msgs/Transform"}},
      {"tf2_msgs/TFMessage", {"geometry_msgs/TransformStamped[] transforms\n", "geometry_msgs/TransformStamped"}},
      {"nav_msgs/Odometry",
       {"std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
        "geometry_msgs/TwistWithCovariance twist\n",
        "std_msgs/Header geometry_msgs/PoseWithCovariance geometry_msgs/TwistWithCovariance"}},
      {"sensor_msgs/LaserScan",
       {"std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
        "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\nfloat32[] ranges\n"
        "float32[] intensities\n",
        "std_msgs/Header"}},
      {"sensor_msgs/LaserEcho", {"float32[] echoes\n", ""}},
      {"sensor_msgs/MultiEchoLaserScan",
       {"std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
        "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\nLaserEcho[] ranges\n"
        "LaserEcho[] intensities\n",
        "std_msgs/Header sensor_msgs/LaserEcho"}},
      {"sensor_msgs/Imu",
       {"std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n"
        "geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n"
        "geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance\n",
        "std_msgs/Header geometry_msgs/Quaternion geometry_msgs/Vector3"}},
      {"sensor_msgs/NavSatStatus", {"int8 status\nuint16 service\n", ""}},
      {"sensor_msgs/NavSatFix",
       {"std_msgs/Header header\nNavSatStatus status\nfloat64 latitude\nfloat64 longitude\nfloat64 altitude\n"
        "float64[9] position_covariance\nuint8 position_covariance_type\n",
        "std_msgs/Header sensor_msgs/NavSatStatus"}},
      {"sensor_msgs/Image",
       {"std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\n"
        "uint8[] data\n",
        "std_msgs/Header"}},
      {"sensor_msgs/CompressedImage", {"std_msgs/Header header\nstring format\nuint8[] data\n", "std_msgs/Header"}},
      {"sensor_msgs/RegionOfInterest",
       {"uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n", ""}},
      {"sensor_msgs/CameraInfo",
       {"std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] d\nfloat64[9] k\n"
        "float64[9] r\nfloat64[12] p\nuint32 binning_x\nuint32 binning_y\nRegionOfInterest roi\n",
        "std_msgs/Header sensor_msgs/RegionOfInterest"}},
      {"sensor_msgs/PointField", {"string name\nuint32 offset\nuint8 datatype\nuint32 count\n", ""}},
      {"sensor_msgs/PointCloud2",
       {"std_msgs/Header header\nuint32 height\nuint32 width\nPointField[] fields\nbool is_bigendian\n"
        "uint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n",
        "std_msgs/Header sensor_msgs/PointField"}},
  };
  return types;
}

void addUsual(const std::string& type, std::map<std::string, bool>& added, std::string& text) {
  if (added[type]) return;
  added[type] = true;
  const UsualType& usual = usualTypes().at(type);
  text += (text.empty() ? "" : "====\nMSG: " + type + "\n") + std::string(usual.fields);
  const std::string contains = usual.contains;
  for (std::size_t at = 0; at < contains.size();) {
    const auto end = std::min(contains.find(' ', at), contains.size());
    addUsual(contains.substr(at, end - at), added, text);
    at = end + 1;
  }
}

}  // namespace

std::string usualDefinition(const std::string& type) {
  std::string text;
  std::map<std::string, bool> added;
  if (usualTypes().count(type) > 0) addUsual(type, added, text);
  return text;
}

}  // namespace omnimapper::ros
