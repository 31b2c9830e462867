#include "CarmenLine.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace omnimapper::source {

namespace {

// The fields of a line, read one after another.
class Fields {
 public:
  explicit Fields(std::string_view line) {
    for (std::size_t i = 0; i < line.size();) {
      if (std::isspace(static_cast<unsigned char>(line[i]))) {
        ++i;
        continue;
      }
      const std::size_t begin = i;
      while (i < line.size() && !std::isspace(static_cast<unsigned char>(line[i]))) ++i;
      fields_.push_back(line.substr(begin, i - begin));
    }
  }

  bool empty() const { return fields_.empty(); }
  std::size_t left() const { return fields_.size() - next_; }

  std::string_view word() {
    if (left() == 0) throw BadCarmenLine("ends too early");
    return fields_[next_++];
  }

  double number() {
    const auto text = word();
    double value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size() || !std::isfinite(value))
      throw BadCarmenLine("has '" + std::string(text) + "' where a number is expected");
    return value;
  }

  std::size_t count() {
    const double value = number();
    if (value < 0 || value != std::floor(value) || value > static_cast<double>(left()))
      throw BadCarmenLine("has fewer readings than it states");
    return static_cast<std::size_t>(value);
  }

  mrpt::math::TPose2D pose() {
    const double x = number(), y = number(), yaw = number();
    return {x, y, yaw};
  }

  // The rest of the line must be this: ipc_timestamp ipc_hostname logger_timestamp.
  base::Stamp stampAtEnd() {
    if (left() != 3)
      throw BadCarmenLine("has " + std::to_string(left()) +
                          " fields after its numbers instead of 3 (stamp, host, stamp of the logger)");
    try {
      return base::parseUnix(std::string(fields_[next_]));
    } catch (const base::Error& error) {
      throw BadCarmenLine(std::string("has a stamp that cannot be read: ") + error.what());
    }
  }

 private:
  std::vector<std::string_view> fields_;
  std::size_t next_ = 0;
};

CarmenOdometryLine parseOdometry(Fields& fields) {
  CarmenOdometryLine odometry;
  odometry.pose = fields.pose();
  odometry.forward_speed = fields.number();
  odometry.turn_rate = fields.number();
  fields.number();  // acceleration
  odometry.stamp = fields.stampAtEnd();
  return odometry;
}

void parseRanges(Fields& fields, CarmenScanLine& scan) {
  scan.ranges.resize(fields.count());
  if (scan.ranges.size() < 2) throw BadCarmenLine("has fewer than two readings");
  for (auto& range : scan.ranges) range = static_cast<float>(fields.number());
}

// FLASER, RLASER: num_readings [readings] laser_x y theta odom_x y theta
CarmenScanLine parseScan(Fields& fields) {
  CarmenScanLine scan;
  parseRanges(fields, scan);
  scan.laser_pose = fields.pose();
  scan.robot_pose = fields.pose();
  scan.stamp = fields.stampAtEnd();
  return scan;
}

// ROBOTLASERn: laser_type start_angle field_of_view angular_resolution maximum_range accuracy remission_mode
// num_readings [readings] num_remissions [remissions] laser_x y theta robot_x y theta laser_tv laser_rv
// forward_safety_dist side_safety_dist turn_axis
CarmenScanLine parseRobotLaser(Fields& fields) {
  CarmenScanLine scan;
  CarmenBeams beams;
  fields.number();  // laser type
  beams.first_angle = fields.number();
  const double field_of_view = fields.number();
  beams.step = fields.number();
  beams.max_range = fields.number();
  const double accuracy = fields.number();
  if (accuracy > 0) beams.sigma = accuracy;
  fields.number();  // remission mode
  parseRanges(fields, scan);
  if (beams.step <= 0) beams.step = field_of_view / static_cast<double>(scan.ranges.size() - 1);
  if (beams.step <= 0) throw BadCarmenLine("states no angle between its beams");
  for (std::size_t i = fields.count(); i > 0; --i) fields.number();
  scan.laser_pose = fields.pose();
  scan.robot_pose = fields.pose();
  for (int i = 0; i < 5; ++i) fields.number();  // speeds of the laser, safety distances, turn axis
  scan.stamp = fields.stampAtEnd();
  scan.beams = beams;
  return scan;
}

bool isMessageName(std::string_view word) {
  return std::isupper(static_cast<unsigned char>(word[0])) &&
         std::all_of(word.begin(), word.end(),
                     [](unsigned char c) { return std::isupper(c) || std::isdigit(c) || c == '-' || c == '_'; });
}

}  // namespace

bool isCarmenWord(std::string_view word) {
  constexpr std::array<std::string_view, 12> kWords = {"PARAM",       "SYNC",        "ODOM",      "FLASER",
                                                       "RLASER",      "TRUEPOS",     "RAWLASER1", "RAWLASER2",
                                                       "ROBOTLASER1", "ROBOTLASER2", "MARKER",    "GLOBALPOS"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

CarmenLine parseCarmenLine(std::string_view line) {
  Fields fields(line);
  if (fields.empty()) return CarmenOtherLine{};
  const std::string name(fields.word());
  if (name[0] == '#') return CarmenOtherLine{};
  if (name == "PARAM") {
    const std::string parameter(fields.word());
    return CarmenParameter{parameter, fields.left() > 0 ? std::string(fields.word()) : ""};
  }
  if (name == "ODOM") return parseOdometry(fields);
  const bool robot_laser = name == "ROBOTLASER1" || name == "ROBOTLASER2";
  if (robot_laser || name == "FLASER" || name == "RLASER") {
    auto scan = robot_laser ? parseRobotLaser(fields) : parseScan(fields);
    scan.name = name;
    return scan;
  }
  if (!isMessageName(name)) throw BadCarmenLine("does not begin with the name of a CARMEN message");
  return CarmenOtherLine{name};
}

}  // namespace omnimapper::source
