#pragma once

#include <omnimapper/source/ObservationGate.h>
#include <omnimapper/source/ObservationSource.h>
#include <omnimapper/source/SourceOptions.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace omnimapper::source {

/// Called before a log is opened, and ten times a second while its first object is awaited; true stops the opening.
using StopOpening = std::function<bool()>;

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
class RawlogSource : public ObservationSource {
  friend std::unique_ptr<ObservationSource> openRawlogs(const std::vector<std::string>& paths,
                                                        const SourceOptions& options, const StopOpening& stop);

 public:
  /// Throws Error(unreadable_input) if the file cannot be opened or is no rawlog, and Error(interrupted) if `stop`
  /// returns true.
  explicit RawlogSource(const std::string& path, const SourceOptions& options = {}, const StopOpening& stop = {});
  ~RawlogSource() override;

  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  SourceReport report() const override;
  void interrupt() override;

  /// The first stamp of the log, if one of its first objects has a stamp.
  std::optional<base::Stamp> firstStamp() const;
  /// Sets the time from which start_s and end_s are counted. By default this is the log's first stamp, or 1970 with
  /// TimeReference::unix_epoch.
  void setLogStart(base::Stamp log_start);
  /// For a log in several files that are read one after the other: sets the gate through which the earlier files
  /// passed. Must be called before next().
  void setGate(std::shared_ptr<ObservationGate> gate);

 private:
  class Stream;
  std::unique_ptr<Stream> stream_;
};

/// Opens one rawlog, or several merged by stamp, with start_s and end_s counted from the earliest first stamp of all.
/// Throws as RawlogSource, and Error(command_line) if there is no path.
std::unique_ptr<ObservationSource> openRawlogs(const std::vector<std::string>& paths, const SourceOptions& options,
                                               const StopOpening& stop = {});

}  // namespace omnimapper::source
