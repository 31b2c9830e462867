#pragma once

#include <omnimapper/source/LogSource.h>
#include <omnimapper/source/SourceOptions.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "ObservationSelection.h"
#include "SandboxedReader.h"

namespace omnimapper::source {

/// The child process that reads a log of a registered format first. Its steps are the opening of the log, and each
/// observation.
std::unique_ptr<SandboxedReader> startReader(const std::string& path, const OpenLog& opener);

/// A log of a registered format, guarded as rawlogs are: the source follows the child process observation by
/// observation; if the child crashes, the log ends before the observation at which it crashed.
class GuardedSource : public LogSource {
 public:
  /// Opens the log, and reads its first observation. `clock_offset` as for ObservationSelection. Throws what `opener`
  /// throws; Error(unreadable_input) if the child crashed when it opened the log; Error(interrupted) if `stop` returns
  /// true.
  GuardedSource(const std::string& path, const OpenLog& opener, std::unique_ptr<SandboxedReader> reader,
                const SourceOptions& options, double clock_offset, const StopOpening& stop);

  mrpt::obs::CObservation::Ptr next() override;
  double progress() const override;
  SourceReport report() const override;
  void interrupt() override;
  TruePoses truth() const override { return log_->truth(); }
  std::optional<geometry::Se3> truthAt(base::Stamp stamp) const override { return log_->truthAt(stamp); }
  std::optional<base::Stamp> firstStamp() const override;
  void setLogStart(base::Stamp log_start) override { selection_.setLogStart(log_start); }

 private:
  mrpt::obs::CObservation::Ptr read(const std::function<bool()>& stop);

  std::string path_;
  std::unique_ptr<SandboxedReader> reader_;
  ObservationSelection selection_;
  std::unique_ptr<ObservationSource> log_;
  mrpt::obs::CObservation::Ptr first_;  // until it is handed out
  std::uint64_t steps_ = 0;
  std::string problem_;  // why the log ends before its end
  std::atomic<bool> interrupted_{false};
};

}  // namespace omnimapper::source
