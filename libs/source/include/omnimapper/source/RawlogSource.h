#pragma once

#include <omnimapper/source/ObservationGate.h>
#include <omnimapper/source/ObservationSource.h>
#include <omnimapper/source/SourceOptions.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace omnimapper::source {

/// Asked before a log is opened, and ten times a second while its first object is waited for; true stops it.
using StopOpening = std::function<bool()>;

/// Streams one rawlog, plain, gzip or bzip2, in either of MRPT's formats or a mixture of both: observations one by one,
/// or pairs of actions and sensory frames. Memory does not grow with the file.
///
/// MRPT's readers can crash on corrupt data. So a child process reads the log a little ahead; this source follows it,
/// object by object, and ends before the one that ended the child.
///
/// An action becomes a CObservationRelativeMotion; SourceOptions say which span of time it is taken for. It is handed
/// out as soon as the end of the span is known: with its action, or right before the frame that ends it. The spans
/// follow each other without a gap. A frame's stamp is the latest of its observations', or else its action's; an
/// observation without a stamp in a frame with one gets the frame's. What comes before anything has a stamp is handed
/// out without one.
///
/// A label is handed out as base::printable() writes it, so that no log can forge lines of a terminal or an INI, and
/// what ObservationGate refuses is left out.
class RawlogSource : public ObservationSource {
 public:
  /// Throws Error(unreadable_input) if the file cannot be opened or is no rawlog, Error(interrupted) if `stop` says so.
  explicit RawlogSource(const std::string& path, const SourceOptions& options = {}, const StopOpening& stop = {});
  ~RawlogSource() override;

  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  SourceReport report() const override;
  void interrupt() override;

  /// The first stamp of the log, if one of its first objects has a stamp.
  std::optional<base::Stamp> firstStamp() const;
  /// What start_s and end_s count from if not 1970; by default the log's own first stamp.
  void setLogStart(base::Stamp log_start);
  /// For a log in several files, read one after the other: the gate that the earlier ones passed. Before next().
  void setGate(std::shared_ptr<ObservationGate> gate);

 private:
  class Stream;
  std::unique_ptr<Stream> stream_;
};

/// One rawlog or several merged by stamp, with start_s and end_s counted from the earliest first stamp of all.
/// Throws as RawlogSource; Error(command_line) if there is no path.
std::unique_ptr<ObservationSource> openRawlogs(const std::vector<std::string>& paths, const SourceOptions& options,
                                               const StopOpening& stop = {});

}  // namespace omnimapper::source
