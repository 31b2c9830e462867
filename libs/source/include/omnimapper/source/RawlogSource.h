#pragma once

#include <omnimapper/source/LogSource.h>
#include <omnimapper/source/ObservationGate.h>
#include <omnimapper/source/SourceOptions.h>

#include <memory>
#include <optional>
#include <string>

namespace omnimapper::source {

/// Streams one rawlog, plain, gzip or bzip2, in either of MRPT's formats or a mixture of both: observations one by one,
/// or pairs of actions and sensory frames. Memory does not grow with the file.
///
/// MRPT's readers can crash on corrupt data. A child process therefore reads the log a little ahead. This source
/// follows the child object by object; if the child crashes, the source ends before the object at which it crashed.
///
/// An action becomes a CObservationRelativeMotion over the span of time that SourceOptions::action_span gives the
/// action. The motion is handed out as soon as the end of its span is known: at the place of the action, or right
/// before the frame that ends the span. The spans follow each other without a gap. The stamp of a frame is the latest
/// stamp of its observations, or else the stamp of its action; observations without a stamp get the stamp of their
/// frame. Observations before the first stamp of the log are handed out without one.
///
/// Labels are converted by base::sensorName(), so that no log can forge lines of a terminal or an INI. Observations
/// that ObservationGate refuses are left out.
class RawlogSource : public LogSource {
 public:
  /// `clock_offset` [s]: of the sensors that options.clock_offsets names, those with this offset are handed out; with 0
  /// also all others. Throws Error(unreadable_input) if the file cannot be opened or is no rawlog, and
  /// Error(interrupted) if `stop` returns true.
  explicit RawlogSource(const std::string& path, const SourceOptions& options = {}, const StopOpening& stop = {},
                        double clock_offset = 0);
  ~RawlogSource() override;

  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  SourceReport report() const override;
  void interrupt() override;

  std::optional<base::Stamp> firstStamp() const override;
  void setLogStart(base::Stamp log_start) override;
  /// For a log in several files that are read one after the other: sets the gate through which the earlier files
  /// passed. Must be called before next().
  void setGate(std::shared_ptr<ObservationGate> gate);

 private:
  class Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace omnimapper::source
