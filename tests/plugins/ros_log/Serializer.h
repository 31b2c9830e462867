#pragma once

#include <omnimapper/base/Bytes.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

// Writes messages as ROS does, independently of what reads them.
namespace omnimapper::ros_test {

/// Serializes numbers and texts one after another, for ROS 1 or as CDR.
class Serializer {
 public:
  explicit Serializer(bool is_cdr, bool is_big_endian = false) : is_cdr_(is_cdr), is_big_(is_big_endian) {
    if (is_cdr) bytes_ = is_big_endian ? std::string("\0\0\0\0", 4) : std::string("\0\1\0\0", 4);
  }
  Serializer& uint(std::uint64_t value, int size) {
    if (is_cdr_)
      while ((bytes_.size() - 4) % static_cast<std::size_t>(size) != 0) bytes_ += '\0';
    std::string part(static_cast<std::size_t>(size), '\0');
    base::toBytes(value, size, part.data());
    bytes_ += is_big_ ? std::string(part.rbegin(), part.rend()) : part;
    return *this;
  }
  Serializer& real(double value) { return uint(base::bitsOf(value), 8); }
  Serializer& reals(const std::vector<double>& values) {
    for (const double value : values) real(value);
    return *this;
  }
  Serializer& real32(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return uint(bits, 4);
  }
  Serializer& sequence(const std::vector<float>& values) {
    uint(values.size(), 4);
    for (const float value : values) real32(value);
    return *this;
  }
  Serializer& text(const std::string& text) {
    const std::string whole = is_cdr_ ? text + '\0' : text;
    uint(whole.size(), 4);
    bytes_ += whole;
    return *this;
  }
  Serializer& raw(const std::string& bytes) {
    bytes_ += bytes;
    return *this;
  }
  /// A header; ROS 1 has a number in front. The stamp is in nanoseconds.
  Serializer& header(std::int64_t stamp, const std::string& frame) {
    if (!is_cdr_) uint(7, 4);
    uint(static_cast<std::uint64_t>(stamp / 1'000'000'000), 4);
    uint(static_cast<std::uint64_t>(stamp % 1'000'000'000), 4);
    return text(frame);
  }
  bool isCdr() const { return is_cdr_; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  bool is_cdr_, is_big_;
};

inline const char* const kHeaderOfRos1 =
    "================\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n";

/// The definitions that bags of ROS 1 have.
inline std::string scanDefinition() {
  return std::string(
             "# Single scan\nHeader header\n\nfloat32 angle_min # [rad]\nfloat32 angle_max\nfloat32 "
             "angle_increment\nfloat32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\n"
             "float32[] ranges\nfloat32[] intensities\n") +
         kHeaderOfRos1;
}
inline std::string transformDefinition() {
  return std::string(
             "geometry_msgs/TransformStamped[] transforms\n=====\nMSG: geometry_msgs/TransformStamped\nHeader "
             "header\nstring child_frame_id\nTransform transform\n====\nMSG: geometry_msgs/Transform\nVector3 "
             "translation\nQuaternion rotation\n====\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 "
             "z\n====\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n") +
         kHeaderOfRos1;
}
inline std::string odometryDefinition() {
  return std::string(
             "Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance "
             "pose\ngeometry_msgs/TwistWithCovariance twist\n====\nMSG: geometry_msgs/PoseWithCovariance\nPose "
             "pose\nfloat64[36] covariance\n====\nMSG: geometry_msgs/Pose\nPoint position\nQuaternion "
             "orientation\n====\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n====\nMSG: "
             "geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n====\nMSG: "
             "geometry_msgs/TwistWithCovariance\nTwist twist\nfloat64[36] covariance\n====\nMSG: "
             "geometry_msgs/Twist\nVector3 linear\nVector3 angular\n====\nMSG: geometry_msgs/Vector3\nfloat64 "
             "x\nfloat64 y\nfloat64 z\n") +
         kHeaderOfRos1;
}

struct ScanFields {
  float first = -1, step = 1, nearest = 0.1F, farthest = 10;  // [rad], [m]
  std::vector<float> ranges = {1, 2, 3};                      // [m]
  std::string frame = "laser";
};
inline std::string scanBytes(bool is_cdr, std::int64_t stamp, const ScanFields& scan = {}) {
  Serializer out(is_cdr);
  out.header(stamp, scan.frame).real32(scan.first);
  out.real32(scan.first + scan.step * static_cast<float>(scan.ranges.size() - 1)).real32(scan.step);
  out.real32(0.01F).real32(0.1F).real32(scan.nearest).real32(scan.farthest);
  return out.sequence(scan.ranges).sequence({}).bytes();
}

/// A pose: x, y, z [m] and a rotation x, y, z, w.
using Pose = std::vector<double>;
inline std::string transformBytes(bool is_cdr, std::int64_t stamp, const std::string& parent, const std::string& child,
                                  const Pose& pose) {
  return Serializer(is_cdr).uint(1, 4).header(stamp, parent).text(child).reals(pose).bytes();
}
inline std::string odometryBytes(bool is_cdr, std::int64_t stamp, const std::string& child, const Pose& pose) {
  Serializer out(is_cdr);
  out.header(stamp, "odom").text(child).reals(pose).reals(std::vector<double>(36, 0));
  return out.reals({0.5, 0, 0, 0, 0, 0.25}).reals(std::vector<double>(36, 0)).bytes();
}

}  // namespace omnimapper::ros_test
