#include "Plan.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace omnimapper::ros {

namespace {

constexpr double kNanosecond = 1e-9;  // [s]

bool contains(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

[[noreturn]] void refuseOption(const std::string& path, const std::string& key, const std::string& reason) {
  throw base::Error(base::ExitCode::command_line, path + ": [source_ros_log] " + key + ": " + reason);
}

// Frames in which a robot is located, not in which its wheels count.
bool isMapFrame(const std::string& frame) {
  return frame == "map" || frame == "world" || frame == "earth" || frame == "utm";
}

constexpr std::array<const char*, 3> kBaseFrames{"base_footprint", "base_link", "base"};

std::int64_t medianOf(std::vector<std::int64_t> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string seconds(std::int64_t nanoseconds, int decimals) {
  return base::fixed(static_cast<double>(nanoseconds) * kNanosecond, decimals) + " s";
}

std::string named(const SensorKey& sensor) {
  return sensor.first + (sensor.second.empty() ? "" : " (frame " + sensor.second + ")");
}

// The sensor whose clock is that of the log: a laser, else a camera, else any.
const std::pair<const SensorKey, SeenSensor>* referenceOf(const Survey& survey) {
  for (const Role role :
       {Role::laser, Role::image, Role::cloud, Role::odometry, Role::imu, Role::gps, Role::transforms})
    for (const auto& one : survey.sensors)
      if (one.second.role == role && !one.second.delays.empty()) return &one;
  return nullptr;
}

}  // namespace

bool isBaseFrame(const std::string& frame) {
  return std::find(kBaseFrames.begin(), kBaseFrames.end(), frame) != kBaseFrames.end();
}

Plan::Plan(const std::string& path, const Survey& survey, const RosLogOptions& options) : options_(options) {
  readLabels(path);
  checkTopics(path, survey);
  for (const auto& [sensor, seen] : survey.sensors)
    if (seen.role != Role::transforms) ++frames_[sensor.first];
  chooseOdometry(path, survey);
  chooseBase(path, survey);
  compareClocks(survey);
  noteSweeps(survey);
  noteClouds(survey);
}

void Plan::readLabels(const std::string& path) {
  for (const auto& pair : options_.labels) {
    const auto equals = pair.rfind('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == pair.size())
      refuseOption(path, "labels", "'" + pair + "' is not of the form /topic=label");
    labels_[pair.substr(0, equals)] = pair.substr(equals + 1);
  }
}

void Plan::checkTopics(const std::string& path, const Survey& survey) const {
  if (!survey.is_complete) return;  // others may come later
  const auto check = [&](const std::string& key, const std::string& topic) {
    const auto& all = survey.sensors;
    if (topic.empty() || std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.first.first == topic; }))
      return;
    std::string known;
    for (const auto& one : all)
      if (known.size() < 500 && known.find(one.first.first + ",") == std::string::npos) known += one.first.first + ", ";
    refuseOption(path, key,
                 "the log has no messages that are read of the topic '" + topic + "'; it has " +
                     (known.empty() ? "none" : known.substr(0, known.size() - 2)));
  };
  for (const auto& topic : options_.topics) check("topics", topic);
  for (const auto& topic : options_.pose_topics) check("pose_topics", topic);
  for (const auto& label : labels_) check("labels", label.first);
  check("truth_topic", options_.truth_topic);
  if (options_.odometry != "automatic" && options_.odometry != "none" && options_.odometry != "tf")
    check("odometry", options_.odometry);
}

OdometrySource Plan::bestTopic(const Survey& survey) const {
  OdometrySource best;
  std::uint64_t most = 0;
  for (const auto& [sensor, seen] : survey.sensors) {
    if (seen.role != Role::odometry || isMapFrame(seen.header_frame) || seen.messages <= most) continue;
    const bool is_wanted = options_.odometry == "automatic"
                               ? takes(sensor.first, seen.role) && sensor.first != options_.truth_topic
                               : options_.odometry == sensor.first;
    if (!is_wanted) continue;
    most = seen.messages;
    best = {sensor.first, seen.header_frame, sensor.second};
  }
  return best;
}

// The frame that moves in one of odometry, of all such the one with most frames of sensors below it. A joint of the
// robot moves, too, but neither in a frame of odometry nor is it a base.
OdometrySource Plan::movingBase(const Survey& survey) const {
  OdometrySource best;
  int most = -1;
  for (const auto& [child, parent] : survey.transforms.movingFrames()) {
    if (isMapFrame(parent) || (parent.find("odom") == std::string::npos && !isBaseFrame(child))) continue;
    int below = 0;
    for (const auto& [sensor, seen] : survey.sensors) {
      const bool is_mounted = seen.role != Role::transforms && seen.role != Role::odometry && seen.role != Role::pose;
      below += is_mounted && contains(survey.transforms.chainFrom(sensor.second), child) ? 1 : 0;
    }
    if (below <= most) continue;
    most = below;
    best = {"", parent, child};
  }
  return best;
}

void Plan::chooseOdometry(const std::string& path, const Survey& survey) {
  if (options_.odometry == "none") return;
  if (options_.odometry != "tf") odometry_ = bestTopic(survey);
  if (odometry_.topic.empty() && (options_.odometry == "automatic" || options_.odometry == "tf"))
    odometry_ = movingBase(survey);
  if (odometry_.child.empty() && odometry_.topic.empty() && options_.odometry == "tf")
    refuseOption(path, "odometry", "no transform of the log moves the base in a frame that is no map");
  if (!odometry_.topic.empty())
    notes_.push_back("odometry: of the topic " + odometry_.topic);
  else if (odometry_.isTransform())
    notes_.push_back("odometry: of the transform from " + odometry_.parent + " to " + odometry_.child);
}

void Plan::chooseBase(const std::string& path, const Survey& survey) {
  const Transforms& tf = survey.transforms;
  base_frame_ = frameName(options_.base_frame);
  if (!base_frame_.empty()) {
    const bool is_known = tf.has(base_frame_) || odometry_.child == base_frame_ || !survey.is_complete ||
                          std::any_of(survey.sensors.begin(), survey.sensors.end(),
                                      [&](const auto& one) { return one.first.second == base_frame_; });
    if (!is_known) refuseOption(path, "base_frame", "the log has no frame '" + base_frame_ + "'");
    return;
  }
  if (!odometry_.child.empty() && (tf.empty() || tf.has(odometry_.child))) base_frame_ = odometry_.child;
  for (const char* usual : kBaseFrames)
    if (base_frame_.empty() && tf.has(usual)) base_frame_ = usual;
  const auto* reference = referenceOf(survey);
  if (base_frame_.empty() && reference && tf.has(reference->first.second)) {
    for (const auto& frame : tf.chainFrom(reference->first.second))
      if (!isMapFrame(frame) && frame.find("odom") == std::string::npos) base_frame_ = frame;
  }
  if (!base_frame_.empty()) notes_.push_back("base: the frame " + base_frame_);
}

void Plan::compareClocks(const Survey& survey) {
  if (options_.stamps == StampsOf::recorded) return;
  const auto* reference = referenceOf(survey);
  if (!reference) return;
  constexpr std::int64_t kLargest = 1'000'000'000;  // [ns] more than messages wait until they are recorded
  reference_delay_ = medianOf(reference->second.delays);
  notes_.push_back("clock: stamps are those of the headers; " + reference->first.first + " was recorded " +
                   seconds(std::abs(reference_delay_), 3) + (reference_delay_ < 0 ? " before" : " after") +
                   " the times in its headers");
  for (const auto& [sensor, seen] : survey.sensors) {
    if (seen.without_time > 0)
      doubts_.push_back(std::to_string(seen.without_time) + " messages of " + named(sensor) +
                        " have no time in their headers; the time of their recording is used");
    if (seen.delays.empty()) continue;
    const std::int64_t difference = medianOf(seen.delays) - reference_delay_;
    if (std::abs(difference) <= kLargest) continue;
    shifts_[sensor] = difference;
    if (seen.role != Role::transforms && seen.role != Role::other)
      doubts_.push_back("the clock of " + named(sensor) + " is " + seconds(std::abs(difference), 3) +
                        (difference > 0 ? " behind" : " ahead of") + " that of " + named(reference->first) +
                        "; its stamps were moved by this");
  }
}

void Plan::noteSweeps(const Survey& survey) {
  for (const auto& [sensor, seen] : survey.sensors)
    if (seen.sweep > 0)
      notes_.push_back(named(sensor) + " sweeps for " + base::fixed(seen.sweep, 4) +
                       " s; as sweep_s in [scan_odometry] this takes the motion out of its scans");
}

// Some clouds have for each point its ring and its time, as those of lasers that turn.
void Plan::noteClouds(const Survey& survey) {
  for (const auto& [sensor, seen] : survey.sensors)
    if (!seen.unused_fields.empty())
      notes_.push_back(named(sensor) + " has points with " + seen.unused_fields +
                       ", which are not used: all points of a cloud count as measured at its stamp");
}

bool Plan::takes(const std::string& topic, Role role, std::string* reason) const {
  std::string why;
  if (role == Role::other)
    why = "a type that is not used";
  else if (role != Role::transforms && !options_.topics.empty() && !contains(options_.topics, topic))
    why = "not among [source_ros_log] topics";
  else if (topic == options_.truth_topic && !givesPoses(topic))
    why = "the true poses";
  else if (role == Role::pose && !givesPoses(topic))
    why = "poses; [source_ros_log] pose_topics or truth_topic can name it";
  else if (role == Role::odometry && options_.odometry == "none" && !givesPoses(topic))
    why = "[source_ros_log] odometry is none";
  if (reason) *reason = why;
  return why.empty();
}

bool Plan::givesPoses(const std::string& topic) const {
  return contains(options_.pose_topics, topic);
}

std::string Plan::labelOf(const SensorKey& sensor) const {
  const auto given = labels_.find(sensor.first);
  std::string label = given != labels_.end() ? given->second : frameName(sensor.first);
  const auto frames = frames_.find(sensor.first);
  if (frames != frames_.end() && frames->second > 1) label += "_" + sensor.second;
  return label;
}

std::int64_t Plan::timeOf(const SensorKey& sensor, std::int64_t header_time, std::int64_t recorded) const {
  if (options_.stamps == StampsOf::recorded) return recorded;
  if (header_time == 0) return boundedTime(recorded - reference_delay_);
  const auto shift = shifts_.find(sensor);
  return shift == shifts_.end() ? header_time
                                : boundedTime(header_time + std::clamp(shift->second, -kLatestTime, kLatestTime));
}

}  // namespace omnimapper::ros
