#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "RosLogOptions.h"
#include "Survey.h"

namespace omnimapper::ros {

/// Where a log's odometry comes from.
struct OdometrySource {
  std::string topic;          ///< of Odometry; empty: not from one
  std::string parent, child;  ///< of a transform, or the frames of the topic
  bool isOf(const std::string& other_topic) const { return !topic.empty() && topic == other_topic; }
  bool isTransform() const { return topic.empty() && !child.empty(); }
};

/// Whether a frame has one of the names that bases usually have: base_footprint, base_link or base.
bool isBaseFrame(const std::string& frame);

/// What is taken from a log, and how.
class Plan {
 public:
  /// Throws Error(command_line) for a topic or a frame in the options that the log does not have.
  Plan(const std::string& path, const Survey& survey, const RosLogOptions& options);

  /// Whether a topic is read; if not, why not in `reason`.
  bool takes(const std::string& topic, Role role, std::string* reason = nullptr) const;
  bool givesPoses(const std::string& topic) const;
  /// The label of a sensor.
  std::string labelOf(const SensorKey& sensor) const;
  /// The stamp of a measurement [ns since 1970].
  std::int64_t timeOf(const SensorKey& sensor, std::int64_t header_time, std::int64_t recorded) const;

  const std::string& baseFrame() const { return base_frame_; }  ///< empty: the log has no frames
  const OdometrySource& odometry() const { return odometry_; }
  const std::vector<std::string>& notes() const { return notes_; }
  const std::vector<std::string>& doubts() const { return doubts_; }

 private:
  void readLabels(const std::string& path);
  void checkTopics(const std::string& path, const Survey& survey) const;
  void chooseOdometry(const std::string& path, const Survey& survey);
  OdometrySource bestTopic(const Survey& survey) const;
  OdometrySource movingBase(const Survey& survey) const;
  void chooseBase(const std::string& path, const Survey& survey);
  void compareClocks(const Survey& survey);
  void noteSweeps(const Survey& survey);
  void noteClouds(const Survey& survey);

  RosLogOptions options_;
  std::map<std::string, std::string> labels_;  // by topic
  std::map<std::string, std::size_t> frames_;  // number of frames of the sensors of a topic
  std::map<SensorKey, std::int64_t> shifts_;   // [ns] to add to the times of headers
  std::int64_t reference_delay_ = 0;           // [ns]
  std::string base_frame_;
  OdometrySource odometry_;
  std::vector<std::string> notes_, doubts_;
};

}  // namespace omnimapper::ros
