#include "RosLog.h"

#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>

#include "CameraObservations.h"
#include "DriverRestarts.h"
#include "LogFiles.h"
#include "Mounting.h"
#include "OdometryOfBase.h"
#include "Plan.h"
#include "ReorderBuffer.h"
#include "TopicTable.h"
#include "truePoses.h"

namespace omnimapper::ros {

using mrpt::obs::CObservation;
using source::SourceReport;

namespace {

constexpr const char* kOdometryOfTransforms = "tf_odometry";

std::string contentOf(const Channels& channels) {
  constexpr std::size_t kMostNamed = 20;
  if (channels.size() == 0) return "has no messages";
  std::string text = "has no messages of which a map can be made: it has";
  for (std::size_t i = 0; i < std::min(channels.size(), kMostNamed); ++i)
    text += std::string(i == 0 ? " " : ", ") + channels[i].topic + " (" + channels[i].type + ")";
  return text + (channels.size() > kMostNamed ? ", and more" : "");
}

}  // namespace

bool RosLog::recognizes(const source::LogLook& look) {
  return looksLikeRos(look);
}

class RosLog::Stream {
 public:
  Stream(const std::string& path, const RosLogOptions& options)
      : options_(options),
        files_(path),
        reader_(files_.present, channels_),
        decoder_(channels_),
        survey_(Survey::of(reader_, channels_, decoder_)),
        plan_(path, survey_, options),
        camera_plan_(survey_),
        cameras_(camera_plan_, decoder_),
        mounting_(plan_),
        odometry_(plan_),
        transforms_(survey_.transforms) {
    decoder_.forgetBad();
    if (survey_.is_complete && !hasSomething())
      source::refuse(path, contentOf(channels_) + (reader_.damage().what.empty() ? "" : ". " + reader_.damage().what));
    if (!options.truth_topic.empty()) truth_ = truePosesOf(options.truth_topic, reader_, channels_, decoder_, plan_);
    decoder_.forgetBad();
  }

  CObservation::Ptr next() {
    while (true) {
      while (auto waiting = buffer_.next())
        if (auto observation = finished(*waiting)) return observation;
      if (is_read_) {
        finish();
        return nullptr;
      }
      is_read_ = !readMessage();
      if (is_read_) buffer_.finish();
    }
  }

  double progress() const { return reader_.progress(); }
  const SourceReport& report() const { return report_; }
  const source::TruePoses& truth() const { return truth_; }

 private:
  bool hasSomething() const {
    if (plan_.odometry().isTransform()) return true;
    return std::any_of(survey_.sensors.begin(), survey_.sensors.end(), [&](const auto& one) {
      const Role role = one.second.role;
      if (role == Role::image && !camera_plan_.use(one.first.first)->problem.empty()) return false;
      return role != Role::transforms && role != Role::camera_info && plan_.takes(one.first.first, role);
    });
  }

  bool readMessage() {
    const auto message = reader_.next();
    if (!message) return false;
    buffer_.reach(message->time);
    ++report_.objects;
    report_.bytes = reader_.bytes();
    const Channel& channel = channels_[message->channel];
    table_.read(channel);
    std::string reason;
    if (!plan_.takes(channel.topic, decoder_.role(message->channel), &reason)) {
      table_.leftOut(channel, reason);
      return true;
    }
    if (const auto value = decoder_.decode(*message)) {
      try {
        take(*value, *message);
        return true;
      } catch (const BadBytes& bad) {
        decoder_.refuse(message->channel, bad.what());
      }
    }
    const std::string& problem = decoder_.problem(message->channel);
    table_.leftOut(channel, problem.empty() ? "a message that " + decoder_.bad(message->channel).last_reason : problem);
    return true;
  }

  void take(const Value& value, const Message& message) {
    const std::string& topic = channels_[message.channel].topic;
    const Role role = decoder_.role(message.channel);
    if (role == Role::transforms) return takeTransforms(value, message);
    if (plan_.givesPoses(topic)) return add(poseObservation(value), headerOf(value).frame, Role::pose, value, message);
    if (role == Role::laser) return add(scanOf(value), headerOf(value).frame, role, value, message);
    if (role == Role::imu) return add(imuOf(value), headerOf(value).frame, role, value, message);
    if (role == Role::gps) return add(gpsOf(value), headerOf(value).frame, role, value, message);
    if (role == Role::cloud) return add(cloudOf(value), headerOf(value).frame, role, value, message);
    if (role == Role::image) return takeImage(value, message);
    if (role == Role::camera_info) return table_.taken(channels_[message.channel], "calibration");
    if (role == Role::odometry) {
      auto odometry = odometryOf(value);
      const std::string child = odometry.frame;
      return add(std::move(odometry), child, role, value, message);
    }
  }

  void takeImage(const Value& value, const Message& message) {
    const Channel& channel = channels_[message.channel];
    const Header header = headerOf(value);
    const CameraUse* use = camera_plan_.use(channel.topic);
    if (!use || !use->problem.empty())
      return table_.leftOut(channel, use ? use->problem : "later than the survey of the log");
    restarts_.see({channel.topic, header.frame}, header, message.time);
    const std::int64_t time = plan_.timeOf({channel.topic, header.frame}, header.time, message.time);
    if (use->is_part_of_depth) {
      cameras_.keep(channel.topic, time, message);
      return table_.taken(channel, "pictures of depths");
    }
    buffer_.add({{nullptr, header.frame, {}},
                 {channel.topic, header.frame},
                 message.channel,
                 Role::image,
                 time,
                 message.time,
                 number_++,
                 message.bytes.size(),
                 detached(message)});
  }

  void add(Converted measured, const std::string& frame, Role role, const Value& value, const Message& message) {
    const SensorKey sensor{channels_[message.channel].topic, frame};
    const Header header = headerOf(value);
    restarts_.see(sensor, header, message.time);
    const std::int64_t time = plan_.timeOf(sensor, header.time, message.time);
    buffer_.add(
        {std::move(measured), sensor, message.channel, role, time, message.time, number_++, message.bytes.size()});
  }

  static Converted poseObservation(const Value& value) {
    auto pose = mrpt::obs::CObservationRobotPose::Create();
    pose->pose.mean = geometry::toMrpt(innerPoseOf(value));
    return {pose, value.has("child_frame_id") ? frameIn(value["child_frame_id"]) : "", {}};
  }

  void takeTransforms(const Value& value, const Message& message) {
    const Channel& channel = channels_[message.channel];
    const bool is_static = isStaticTopic(channel.topic);
    for (const auto& one : transformsOf(value)) {
      const SensorKey key{channel.topic, one.child};
      const std::int64_t time = plan_.timeOf(key, one.time, message.time);
      transforms_.add(one.parent, one.child, time, one.parent_from_child, is_static);
      const auto& odometry = plan_.odometry();
      if (!odometry.isTransform() || one.child != odometry.child || one.parent != odometry.parent) continue;
      auto observation = mrpt::obs::CObservationOdometry::Create();
      observation->odometry = mrpt::poses::CPose2D(geometry::toMrpt(geometry::project(one.parent_from_child)));
      buffer_.add({{observation, one.child, {}},
                   {kOdometryOfTransforms, ""},
                   message.channel,
                   Role::transforms,
                   time,
                   message.time,
                   number_++,
                   0});
    }
    table_.taken(channel, "transforms");
    constexpr std::int64_t kKept = 4 * kHeldBack;
    if (message.time - pruned_ > kKept) {
      pruned_ = message.time;
      transforms_.forgetBefore(plan_.timeOf({}, 0, message.time) - 5 * kKept);
    }
  }

  // The observation with label, stamp and sensor pose; null if it is left out.
  CObservation::Ptr finished(Waiting& waiting) {
    const Channel& channel = channels_[waiting.channel];
    try {
      if (waiting.image) waiting.measured = cameras_.make(channel.topic, waiting.time, *waiting.image, transforms_);
    } catch (const BadBytes& bad) {
      decoder_.refuse(waiting.channel, bad.what());
      table_.leftOut(channel, std::string("a message that ") + bad.what());
      return nullptr;
    }
    const bool is_odometry = waiting.role == Role::odometry || waiting.role == Role::transforms;
    const auto reason = is_odometry ? odometry_.move(waiting, transforms_) : mounting_.mount(waiting, transforms_);
    const std::string label = plan_.labelOf(waiting.sensor);
    if (!reason.empty()) {
      table_.leftOut(channel, reason);
      return nullptr;
    }
    if (waiting.role != Role::transforms) table_.taken(channel, label);
    auto observation = waiting.measured.observation;
    observation->sensorLabel = label;
    observation->timestamp = stampOf(waiting.time);
    report_.count(label, observation->GetRuntimeClass()->className, observation->timestamp);
    return observation;
  }

  void finish() {
    if (report_.ending != SourceReport::Ending::open) return;
    auto& notes = report_.notes;
    notes = plan_.notes();
    for (const auto& note : reader_.notes()) notes.push_back(note);
    for (const auto& line : table_.lines()) notes.push_back(line);
    for (const auto& file : files_.left_out)
      notes.push_back(file + " is left out, as metadata.yaml does not list it; to read it, name it itself");
    if (reader_.unordered() > 0)
      notes.push_back("messages out of the order of their times: " + std::to_string(reader_.unordered()));
    if (cameras_.withoutPicture() > 0)
      notes.push_back("depth images without a picture at their time: " + std::to_string(cameras_.withoutPicture()));
    report_.other_objects = table_.unusedTypes();
    report_.doubts = plan_.doubts();
    for (const auto& file : files_.missing)
      report_.doubts.push_back(file + " is missing, although metadata.yaml lists it");
    for (const auto& doubt : restarts_.doubts(plan_)) report_.doubts.push_back(doubt);
    doubtTruth();
    mounting_.addTo(report_);
    const Damage damage = reader_.damage();
    report_.ending = damage.what.empty() ? SourceReport::Ending::complete
                     : damage.is_cut     ? SourceReport::Ending::truncated
                                         : SourceReport::Ending::corrupt;
    if (!damage.what.empty())
      report_.message = damage.what + ". What can be read was read; copy or download the log again for the rest.";
  }

  // A tracker gives the poses of what it tracks.
  void doubtTruth() {
    const std::string& topic = options_.truth_topic;
    const bool is_of_base = std::any_of(survey_.sensors.begin(), survey_.sensors.end(), [&](const auto& one) {
      return one.first.first == topic && one.second.role == Role::odometry && one.first.second == plan_.baseFrame();
    });
    if (topic.empty() || is_of_base) return;
    report_.doubts.push_back(
        "the true poses of " + topic +
        " are those of the body that it names or tracks, which may not be the base: compare a "
        "trajectory with them by omnimapper-eval ate --align se3 --solve-offset, and give them to a map only "
        "if that body is the base");
  }

  RosLogOptions options_;
  Channels channels_;
  LogFiles files_;
  MessageReader reader_;
  ChannelDecoder decoder_;
  Survey survey_;
  Plan plan_;
  CameraPlan camera_plan_;
  CameraObservations cameras_;
  Mounting mounting_;
  OdometryOfBase odometry_;
  Transforms transforms_;
  ReorderBuffer buffer_;
  DriverRestarts restarts_;
  TopicTable table_;
  SourceReport report_;
  source::TruePoses truth_;
  std::uint64_t number_ = 0;
  std::int64_t pruned_ = 0;  // time of recording at which transforms were forgotten
  bool is_read_ = false;     // all messages are
};

RosLog::RosLog(const std::string& path, const RosLogOptions& options)
    : stream_(std::make_unique<Stream>(path, options)) {}
RosLog::~RosLog() = default;

CObservation::Ptr RosLog::next() {
  return stream_->next();
}
double RosLog::progress() const {
  return stream_->progress();
}
SourceReport RosLog::report() const {
  return stream_->report();
}
source::TruePoses RosLog::truth() const {
  return stream_->truth();
}
std::optional<geometry::Se3> RosLog::truthAt(base::Stamp stamp) const {
  return poseAt(stream_->truth(), stamp);
}

}  // namespace omnimapper::ros
