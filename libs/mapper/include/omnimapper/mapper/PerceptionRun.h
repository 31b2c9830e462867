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

/// What a user asks of one run of perception alone.
struct PerceptionRequest {
  std::vector<std::string> logs;  ///< rawlogs, merged by stamp
  std::string output;             ///< rawlog to write
  bool with_raw = false;          ///< the observations that were read go into it too, images inside
  int threads = 1;                ///< the bytes do not depend on it
  /// Where there is one, it is told each observation and what was derived of it, in the order of the log.
  std::function<void(const mrpt::obs::CObservation& raw, const std::vector<mrpt::obs::CObservation::Ptr>& derived)>
      show;
};

struct PerceptionResult {
  base::ExitCode code = base::ExitCode::ok;
  std::vector<std::string> warnings;
  source::SourceReport source;  ///< of what was read
  struct Count {
    std::string section;
    std::size_t taken = 0;    ///< observations it made something of
    std::size_t derived = 0;  ///< what of that was written
    std::size_t failed = 0;   ///< observations it threw base::Error for; they are left out
    /// Of those taken, how many showed nothing new, so that what was made of the one before is what they gave.
    std::size_t unchanged = 0;
  };
  std::vector<Count> extractors;
  double wall_seconds = 0;
};
std::string toText(const PerceptionResult& result, const std::string& output);

/// Log in, log out: what the extractors of [perception] derive from each observation, in the order of the log. They are
/// the ones the mapper runs, and get the same bits, so a map of the perceived log is that of the raw one. Of several
/// with one stamp, label and class the first is written, and with `with_raw` the one that was read. Damaged input and
/// `stop` still give the log of what was read, with their own code; so do observations that an extractor throws
/// base::Error for, with missing_images if the first lacks them, else damaged_input. Throws that error if none could be
/// taken, base::Error if no extractor is named or takes anything, and all that keeps a log from being written.
PerceptionResult runPerception(const PerceptionRequest& request, const base::Config& config, base::Progress& progress,
                               const std::function<bool()>& stop);

}  // namespace omnimapper::mapper
