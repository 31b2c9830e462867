#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::check {

struct CheckResult {
  base::ExitCode code = base::ExitCode::ok;
  std::string text;  ///< one screen: content of the log, findings, INIs that fit the log, settings to change
};

/// Judges logs (several are merged by stamp) before they are mapped. Of `config`, which may be empty, only [source],
/// the sensors, the lists of plugins and `[odometry] fallback` are used. If `output_folder` is not empty, check.txt is
/// written there, and check.ini if one of the project's INIs fits. The exit code is that of the source's report if the
/// log is damaged, nothing_to_map if none of the project's INIs fits, doubtful_input if a finding (see judge.h) is a
/// problem, else ok. Throws base::Error as source::openLogs() and base::writeFile() do.
CheckResult runCheck(const std::vector<std::string>& logs, const base::Config& config, const std::string& output_folder,
                     base::Progress& progress, const std::function<bool()>& stop);

}  // namespace omnimapper::check
