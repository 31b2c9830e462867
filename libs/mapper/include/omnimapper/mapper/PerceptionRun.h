#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/source/SourceReport.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace omnimapper::mapper {

/// What a user requests of one run of perception alone.
struct PerceptionRequest {
  std::vector<std::string> logs;  ///< rawlogs, merged by stamp
  std::string output;             ///< rawlog to write
  bool with_raw = false;          ///< also write the observations that were read, with their images embedded
  int threads = 1;                ///< the bytes of the output do not depend on it
  /// Called with each observation and what was derived from it, in the order of the log; may be empty.
  std::function<void(const mrpt::obs::CObservation& raw, const std::vector<mrpt::obs::CObservation::Ptr>& derived)>
      show;
};

struct PerceptionResult {
  base::ExitCode code = base::ExitCode::ok;
  std::vector<std::string> warnings;
  source::SourceReport source;  ///< on the observations that were read
  struct Count {
    std::string section;
    std::size_t taken = 0;    ///< observations from which the extractor derived something
    std::size_t derived = 0;  ///< derived observations that were written
    std::size_t failed = 0;   ///< observations for which the extractor threw base::Error
    /// Number of observations that showed nothing new, so that the result of the previous observation was used again.
    std::size_t unchanged = 0;
  };
  std::vector<Count> extractors;
  double wall_seconds = 0;
};
std::string toText(const PerceptionResult& result, const std::string& output);

/// Writes a log of what the extractors of [perception] derive from each observation, in the order of the input log. The
/// mapper runs the same extractors on the same bits, so the map of this log is the same as that of the raw log. Of
/// several derived observations with the same stamp, label and class, only the first is written. None of them is
/// written if `with_raw` writes an observation of the input log with this stamp, label and class. After damaged input
/// or `stop`, it still writes the log of what was read and returns the exit code of the cause. If an extractor throws
/// base::Error for some observations, the code is missing_images if the first of these observations lacks its images,
/// else damaged_input. If extraction failed for every observation, the first of these errors is thrown. base::Error is
/// also thrown if no extractor is named, if nothing was derived, or if anything else prevents the log from being
/// written.
PerceptionResult runPerception(const PerceptionRequest& request, const base::Config& config, base::Progress& progress,
                               const std::function<bool()>& stop);

}  // namespace omnimapper::mapper
