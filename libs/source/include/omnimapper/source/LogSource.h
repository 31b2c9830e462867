#pragma once

#include <omnimapper/base/Stamp.h>
#include <omnimapper/source/ObservationSource.h>

#include <functional>
#include <optional>

namespace omnimapper::source {

/// Called before a log is opened, and ten times a second while its first object is awaited; true stops the opening.
using StopOpening = std::function<bool()>;

/// One log, whose observations are selected by time.
class LogSource : public ObservationSource {
 public:
  /// The first stamp of the log, if one of its first objects has a stamp.
  virtual std::optional<base::Stamp> firstStamp() const = 0;
  /// Sets the time from which start_s and end_s are counted. By default this is the log's first stamp, or 1970 with
  /// TimeReference::unix_epoch.
  virtual void setLogStart(base::Stamp log_start) = 0;
};

}  // namespace omnimapper::source
