#include "Survey.h"

#include "Converted.h"

namespace omnimapper::ros {

namespace {

constexpr std::uint64_t kSurveyed = std::uint64_t{1} << 28;  // [bytes] of messages
constexpr std::size_t kMostDelays = 2000;                    // of a sensor
constexpr std::size_t kMostSensors = 10'000;

void addDelay(SeenSensor& sensor, std::int64_t header_time, std::int64_t recorded) {
  if (header_time == 0)
    ++sensor.without_time;
  else if (sensor.delays.size() < kMostDelays)
    sensor.delays.push_back(recorded - header_time);
}

std::string frameOfSensor(Role role, const Value& message, const Header& header) {
  return role == Role::odometry ? frameIn(message["child_frame_id"]) : header.frame;
}

void addCamera(const Value& info, const std::string& topic, const std::string& frame, Survey& survey) {
  if (survey.cameras.count(topic) > 0) return;
  CalibratedCamera& camera = survey.cameras[topic];
  camera.frame = frame;
  try {
    camera.rectified = cameraOf(info, true);
    camera.raw = cameraOf(info, false);
  } catch (const BadBytes& bad) {
    camera.problem = bad.what();
  }
}

std::string unusedFieldsOf(const Value& cloud) {
  constexpr std::size_t kLongest = 200;  // [bytes]
  const Value& fields = cloud["fields"];
  std::string names;
  for (std::size_t i = 0; i < fields.size() && names.size() < kLongest; ++i) {
    const std::string_view name = fields[i]["name"].text();
    if (name != "x" && name != "y" && name != "z") names.append(names.empty() ? "" : ", ").append(name, 0, kLongest);
  }
  return names;
}

void look(const Value& message, const Channel& channel, Role role, std::int64_t recorded, Survey& survey) {
  const Header header = headerOf(message);
  if (role == Role::camera_info) addCamera(message, channel.topic, header.frame, survey);
  const SensorKey key{channel.topic, frameOfSensor(role, message, header)};
  if (survey.sensors.size() >= kMostSensors && survey.sensors.count(key) == 0) return;
  SeenSensor& sensor = survey.sensors[key];
  sensor.role = role;
  sensor.header_frame = header.frame;
  ++sensor.messages;
  addDelay(sensor, header.time, recorded);
  if (role == Role::laser) sensor.sweep = sweepOf(message);
  if (role == Role::cloud) sensor.unused_fields = unusedFieldsOf(message);
  if (role == Role::image) sensor.content = imageContentOf(message.either("encoding", "format").text(), channel.topic);
}

void lookAtTransforms(const Value& message, const Channel& channel, std::int64_t recorded, Survey& survey) {
  const bool is_static = isStaticTopic(channel.topic);
  for (const auto& one : transformsOf(message)) {
    survey.transforms.add(one.parent, one.child, one.time, one.parent_from_child, is_static);
    const SensorKey key{channel.topic, one.child};
    if (is_static || (survey.sensors.size() >= kMostSensors && survey.sensors.count(key) == 0)) continue;
    SeenSensor& sensor = survey.sensors[key];
    sensor.role = Role::transforms;
    sensor.header_frame = one.parent;
    ++sensor.messages;
    addDelay(sensor, one.time, recorded);
  }
}

}  // namespace

bool isStaticTopic(const std::string& topic) {
  const std::string ending = "tf_static";
  return topic.size() >= ending.size() && topic.compare(topic.size() - ending.size(), ending.size(), ending) == 0;
}

std::vector<StampedTransform> transformsOf(const Value& message) {
  const Value& list = message["transforms"];
  std::vector<StampedTransform> transforms;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Header header = headerOf(list[i]);
    try {
      transforms.push_back(
          {header.frame, frameIn(list[i]["child_frame_id"]), header.time, poseOf(list[i]["transform"])});
    } catch (const BadBytes&) {
    }
  }
  return transforms;
}

Survey Survey::of(MessageReader& reader, const Channels& channels, ChannelDecoder& decoder) {
  Survey survey;
  while (reader.bytes() < kSurveyed) {
    const auto message = reader.next();
    survey.is_complete = !message;
    if (!message) break;
    const auto value = decoder.decode(*message);
    if (!value) continue;
    const Role role = decoder.role(message->channel);
    try {
      if (role == Role::transforms)
        lookAtTransforms(*value, channels[message->channel], message->time, survey);
      else
        look(*value, channels[message->channel], role, message->time, survey);
    } catch (const BadBytes&) {  // counted when the message is read again
    }
  }
  reader.rewind();
  return survey;
}

}  // namespace omnimapper::ros
