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
  std::string text;  ///< for a screen: what the log holds, findings, INIs that fit, what to change
};

/// Judges logs (several are merged by stamp) before they are mapped. Of `config` the section [source], the
/// sensors and the lists of plugins count; it may be empty. With an output folder, leaves check.txt and check.ini
/// there. The code: that of damaged input, if it is; nothing_to_map where none of the project's INIs fits;
/// doubtful_input if a finding is a problem; else ok. Throws base::Error as source::openRawlogs() and
/// base::writeFile().
CheckResult runCheck(const std::vector<std::string>& logs, const base::Config& config, const std::string& output_folder,
                     base::Progress& progress, const std::function<bool()>& stop);

}  // namespace omnimapper::check
