#pragma once

#include <omnimapper/source/LogLook.h>
#include <omnimapper/source/ObservationSource.h>

#include <memory>
#include <string>

#include "RosLogOptions.h"

namespace omnimapper::ros {

/// Streams a log of ROS as MRPT observations: a bag of ROS 1 (2.0), an MCAP or SQLite file of ROS 2, or the folder of a
/// split log. Messages are decoded by the definitions in the log, and by those of ROS 2 in logs that have none.
///
/// The survey of its beginning decides (Plan): which topics are sensors, where the odometry comes from, which frame is
/// the base, and how the clocks of the topics differ. Sensors are mounted as the transforms say, at the time of each
/// measurement, so that joints may move. A sensor whose frame is not connected with the base is taken to be at the
/// base, which report().doubts says. Observations come in the order of their stamps, except where the headers of two
/// messages are more than half a second further apart than the times of their recording.
class RosLog : public source::ObservationSource {
 public:
  static constexpr const char* kName = "ros_log";
  static constexpr const char* kSummary = "a log of ROS (a bag, an MCAP or .db3 file, or a folder of them)";
  static bool recognizes(const source::LogLook& look);

  /// Throws Error(unreadable_input) if the log cannot be opened or has no message that is read, with what it has.
  explicit RosLog(const std::string& path, const RosLogOptions& options = {});
  ~RosLog() override;

  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  /// `objects` counts messages. The notes have a line for each topic: what was taken, what was left out, and why.
  source::SourceReport report() const override;
  /// The poses of the topic RosLogOptions::truth_topic, in its frame: of the body that it tracks, which may not be the
  /// base.
  source::TruePoses truth() const override;
  /// Interpolated between two true poses that are at most 0.2 s apart.
  std::optional<geometry::Se3> truthAt(base::Stamp stamp) const override;

 private:
  class Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace omnimapper::ros
