#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/live/LiveSource.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::live {

/// The result of a recording.
struct Recorded {
  std::vector<std::string> files;  ///< rawlogs, with the folder
  std::vector<SensorMetrics> sensors;
  LiveCounts counts;
  Recorder::Statistics statistics;
  double seconds = 0;   ///< time for which the sensors were open
  std::string failure;  ///< why the recording ended early; empty if it did not

  base::ExitCode code() const;
};

/// Records the sensors of an INI into `folder`, which is made if it is missing, until `stop` returns true, the
/// recording fails, or `seconds` have passed (0: no limit). Throws Error as readSensors(), LiveSource::open() and
/// Recorder.
Recorded record(const LiveOptions& options, const base::Config& config, const std::string& folder, double seconds,
                base::Progress& progress, const std::function<bool()>& stop);

/// A sentence for each sensor that sent no usable data, or was silent or lost at the end.
std::vector<std::string> troublesOf(const Recorded& recorded);

/// The summary for a screen.
std::string toText(const Recorded& recorded);

}  // namespace omnimapper::live
